// What counts as a save, and when it is told, without a file or a clock.
#include "base/save_notice.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

namespace glint::save_notice_test {
namespace {

using namespace std::chrono_literals;
using enum FileEvent;
using Time = SaveNotice::Time;

const Time kStart{std::chrono::hours(1)};
const FileStamp kWhole{.inode = 7, .size = 100, .modified_ns = 1, .status_ns = 1, .mode = 0644};
const FileStamp kEmpty{.inode = 7};
const FileStamp kGone{};

struct Heard {
    std::chrono::milliseconds at;
    FileEvent event;
    FileStamp then;
};

// When the file is reported, from the start, if it is asked in every millisecond.
std::vector<long> reports_of(const std::vector<Heard>& events) {
    SaveNotice notice;
    std::vector<long> reports;
    std::size_t next = 0;
    for (auto now = 0ms; now < 2000ms; ++now) {
        for (; next < events.size() && events[next].at == now; ++next)
            notice.heard(events[next].event, events[next].then, kStart + now);
        if (!notice.is_due(kStart + now)) continue;
        reports.push_back(now.count());
        notice.reported();
    }
    return reports;
}

TEST(SaveNotice, TellsAtOnceWhatIsWholeAndWaitsForWhatMayGoOn) {
    struct Case {
        const char* what;
        std::vector<Heard> events;
        std::vector<long> reports;  // ms
    };
    const Case cases[] = {
        {"nothing", {}, {}},
        {"written and closed", {{1ms, written, kWhole}, {2ms, closed, kWhole}}, {2}},
        {"written and kept open", {{1ms, written, kWhole}}, {6}},
        {"in two chunks, kept open", {{1ms, written, kWhole}, {4ms, written, kWhole}}, {9}},
        {"closed, then appended to, within a millisecond",
         {{1ms, closed, kWhole}, {1ms, written, kWhole}},
         {6}},
        {"renamed over", {{1ms, moved_in, kWhole}}, {1}},
        {"renamed over twice within a millisecond",
         {{1ms, moved_in, kWhole}, {1ms, moved_in, kWhole}},
         {1}},
        {"renamed over by an empty one", {{1ms, moved_in, kEmpty}}, {101}},
        {"two saves, a millisecond between",
         {{1ms, closed, kWhole}, {2ms, closed, kWhole}},
         {1, 2}},
        {"cut off, and written later",
         {{1ms, written, kEmpty}, {2ms, closed, kEmpty}, {10ms, closed, kWhole}},
         {10}},
        {"cut off for good", {{1ms, closed, kEmpty}}, {101}},
        {"deleted and created again",
         {{1ms, went, kGone}, {3ms, came, kEmpty}, {4ms, closed, kWhole}},
         {4}},
        {"deleted for good", {{1ms, went, kGone}}, {101}},
        {"deleted, and a link to it dangles", {{1ms, led_away, kGone}}, {101}},
        {"a link leads elsewhere", {{1ms, led_away, kWhole}}, {1}},
        {"its folder went, and another is there", {{1ms, folder_went, kWhole}}, {6}},
        {"its folder went", {{1ms, folder_went, kGone}}, {101}},
        {"its folder went and came again with it",
         {{1ms, folder_went, kGone}, {30ms, came, kWhole}, {31ms, closed, kWhole}},
         {31}},
        {"readable at last", {{1ms, readable, kWhole}}, {6}},
    };
    for (const Case& c : cases) EXPECT_EQ(reports_of(c.events), c.reports) << c.what;
}

TEST(SaveNotice, AFileThatIsWrittenToAllTheTimeIsToldOfAllTheSame) {
    std::vector<Heard> events;
    for (auto at = 0ms; at < 1000ms; at += 2ms) events.push_back({at, written, kWhole});
    EXPECT_EQ(reports_of(events), (std::vector<long>{250, 502, 754, 1003}));
}

TEST(SaveNotice, WhatHappensAfterAReportIsReportedAgain) {
    SaveNotice notice;
    notice.heard(closed, kWhole, kStart);
    EXPECT_TRUE(notice.is_whole());
    EXPECT_EQ(notice.due(), Time()) << "at once";
    notice.reported();
    EXPECT_FALSE(notice.is_pending());
    EXPECT_EQ(notice.due(), std::nullopt);
    notice.heard(closed, kWhole, kStart);  // in the same millisecond
    EXPECT_TRUE(notice.is_due(kStart));
}

TEST(SaveNotice, WhatWasLostInTheQueueCountsAsASave) {
    SaveNotice notice;
    notice.lost_count(kWhole, kStart);
    EXPECT_TRUE(notice.is_due(kStart));
    SaveNotice gone;
    gone.lost_count(kGone, kStart);
    EXPECT_FALSE(gone.is_due(kStart)) << "perhaps it is to be created again";
    EXPECT_TRUE(gone.is_due(kStart + 100ms));
}

TEST(SaveNotice, WhatIsOnlySeenByLookingIsLookedAtTwice) {
    SaveNotice notice;
    notice.found(kWhole, kStart);
    EXPECT_FALSE(notice.is_whole());
    EXPECT_FALSE(notice.is_due(kStart + 9ms));
    EXPECT_TRUE(notice.is_due(kStart + 10ms));
    notice.grew(kStart + 10ms);  // it is another still
    EXPECT_FALSE(notice.is_due(kStart + 19ms));
    EXPECT_TRUE(notice.is_due(kStart + 20ms));
    for (auto at = 20ms; at < 250ms; at += 10ms) notice.grew(kStart + at);
    EXPECT_TRUE(notice.is_due(kStart + 250ms)) << "but not for ever";
    SaveNotice empty, gone;
    empty.found(kEmpty, kStart);
    gone.found(kGone, kStart);
    EXPECT_EQ(empty.due(), kStart + 100ms);
    EXPECT_EQ(gone.due(), kStart + 100ms);
}

TEST(IsAnother, AsksForMoreWhereNobodyTells) {
    FileStamp longer = kWhole, later = kWhole, replaced = kWhole, moved = kWhole, rights = kWhole;
    longer.size = 101;
    later.modified_ns = 2;
    replaced.inode = 8;
    moved.device = 1;
    rights.mode = 0600, rights.status_ns = 2;
    const std::pair<const char*, FileStamp> others[] = {{"longer", longer},
                                                        {"later, of the same length", later},
                                                        {"renamed over", replaced},
                                                        {"on another disk", moved},
                                                        {"gone", kGone}};
    for (const auto& [what, now] : others) {
        EXPECT_TRUE(is_another(kWhole, now, true)) << what;
        EXPECT_TRUE(is_another(kWhole, now, false)) << what;
    }
    EXPECT_FALSE(is_another(kWhole, kWhole, true));
    EXPECT_FALSE(is_another(kWhole, kWhole, false));
    EXPECT_FALSE(is_another(kWhole, rights, true)) << "that would have been heard";
    EXPECT_TRUE(is_another(kWhole, rights, false)) << "it may be readable at last";
}

}  // namespace
}  // namespace glint::save_notice_test
