// What is recorded gives the same Inputs when it is replayed.
#include "scene/recording.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace glint::recording_test {
namespace {

constexpr glm::ivec2 kSize(1280, 720);
constexpr double kBefore = -std::numeric_limits<double>::infinity();

// A person who does one thing after the other, seen by a live input and a recorder.
struct Session {
    InputState input;
    Recorder recorder;

    void mouse(glm::dvec2 fraction, bool down) {
        input.mouse(fraction, down);
        recorder.mouse(fraction, down);
    }
    void key(int code, bool down) {
        input.key(code, down);
        recorder.key(code, down);
    }
    Input draw(double time) {
        recorder.frame(time);
        return input.next_frame(kSize);
    }
};

void do_something(Session& session, std::mt19937& random) {
    const auto pick = [&random](unsigned count) { return random() % count; };
    const glm::ivec2 cursor(pick(1400), pick(800));
    const glm::dvec2 fraction = mouse_fraction(cursor, kSize);
    switch (pick(6)) {
        case 0:
            return session.mouse(fraction, pick(2) != 0);
        case 1:
        case 2:
            session.mouse(fraction, true);
            return session.mouse(fraction, pick(2) != 0);
        case 3:
            return session.mouse({std::nan(""), 0.5}, pick(2) != 0);
        default:
            return session.key(65 + static_cast<int>(pick(4)), pick(2) != 0);
    }
}

TEST(MouseFraction, IsThePixelUnderTheCursorInEverySize) {
    for (const int width : {1, 3, 100, 1280, 1920, 3840, 16384}) {
        const glm::ivec2 size(width, width);
        for (int x = 0; x < width; x += 1 + width / 500) {
            for (const double part : {0.0, 0.3, 0.99}) {
                InputState state;
                state.mouse(mouse_fraction(glm::dvec2(x + part), size), true);
                const Input input = state.next_frame(size);
                ASSERT_EQ(input.mouse.x, static_cast<float>(x)) << width;
                ASSERT_EQ(input.mouse.y, static_cast<float>(width - 1 - x)) << width;
            }
        }
    }
    EXPECT_LT(mouse_fraction({-5, 800}, kSize).x, 0.0);
    EXPECT_LT(mouse_fraction({-5, 800}, kSize).y, 0.0);
    EXPECT_TRUE(std::isfinite(mouse_fraction({5, 5}, {0, 0}).x));
}

TEST(Recorder, WhatTheEventsBeforeLeadToIsNotSaidAgain) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        std::mt19937 random(seed);
        Session session;
        session.recorder.start(kBefore, session.input);
        for (int i = 0; i < 20; ++i) do_something(session, random);
        session.draw(1.0);
        const std::span<const Event> done = session.recorder.events();
        const std::vector<Event> before(done.begin(), done.end());
        session.recorder.start(1.0, session.input, before);
        EXPECT_TRUE(session.recorder.events().empty()) << seed;
        // What was done meanwhile, unseen by a recorder, is.
        Session other = session;
        for (int i = 0; i < 20; ++i) do_something(other, random);
        other.input.next_frame(kSize);
        std::vector<Event> all = before;
        for (const Event& event : other.input.as_events(2.0, session.input)) all.push_back(event);
        EXPECT_EQ(replay(all, 2.0, 2.0, kSize), other.input.next_frame(kSize)) << seed;
    }
}

TEST(Recorder, AReplayGivesTheSameInputsAtTheSameFrames) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> wall(0.0005, 0.05);
        Session session;
        double time = 0.0;
        const bool from_the_start = seed % 2 == 0;
        if (!from_the_start) {
            for (int k = 0; k < 20; ++k) do_something(session, random);
            session.draw(time = 3.21);
        }
        const double begin = from_the_start ? kBefore : time;
        session.recorder.start(begin, session.input);
        std::vector<std::pair<double, Input>> frames;
        for (int k = 0; k < 200; ++k) {
            if (k > 0 || !from_the_start) time += wall(random);
            for (auto n = random() % 5; n > 0; --n) do_something(session, random);
            frames.emplace_back(time, session.draw(time));
        }
        const std::vector<Event> events = session.recorder.stop();
        InputState again;
        for (const Event& e : events_between(events, kBefore, begin)) again.apply(e);
        again.next_frame(kSize);
        double previous = begin;
        for (const auto& [at, input] : frames) {
            ASSERT_EQ(replay(events, previous, at, kSize), input) << seed << " at " << at;
            for (const Event& e : events_between(events, previous, at)) again.apply(e);
            ASSERT_EQ(again.next_frame(kSize), input) << seed << " at " << at;
            previous = at;
        }
    }
}

TEST(Recorder, RedundantEventsAreLeftOut) {
    Session session;
    session.recorder.start(kBefore, session.input);
    for (int k = 0; k < 10; ++k) session.mouse({0.1 * k, 0.5}, false);
    session.draw(0.0);
    for (int k = 0; k < 3; ++k) session.key(65, true);
    session.mouse({0.1, 0.1}, true);
    for (int k = 2; k < 9; ++k) session.mouse({0.1 * k, 0.1}, true);
    session.draw(0.5);
    session.mouse({0.8, 0.1}, true);  // has not moved
    session.draw(1.0);
    for (int k = 0; k < 3; ++k) session.mouse({0.9, 0.9}, false);
    session.draw(1.5);
    const std::span<const Event> events = session.recorder.events();
    ASSERT_EQ(events.size(), 4u) << "key, press, last move, release";
    EXPECT_EQ(events[0].key, 65);
    EXPECT_EQ(events[1].mouse.x, 0.1);
    EXPECT_EQ(events[2].mouse.x, 0.8);
    EXPECT_FALSE(events[3].down);
    EXPECT_EQ(events[3].time, 1.5);
}

TEST(Recorder, TimesAreShortAndBetweenTheFrames) {
    struct Case {
        double before, time, stamp;
    };
    const Case cases[] = {{3.0, 3.0166666666666666, 3.01},
                          {3.01, 3.0166666666666666, 3.016},
                          {3.016, 3.0166666666666666, 3.0166},
                          {3.01666666, 3.0166666666666666, 3.0166666666666666},
                          {0.0, 0.5, 0.5}};
    for (const Case& c : cases) {
        Session session;
        session.recorder.start(c.before, session.input);
        session.key(65, true);
        session.draw(c.time);
        EXPECT_EQ(session.recorder.stop().at(0).time, c.stamp) << c.time;
    }
}

TEST(Recorder, WhatAPresetReplaysKeepsItsTimeAmongWhatAPersonDoes) {
    Session session;
    session.recorder.start(1.0, session.input);
    session.key(65, true);
    session.recorder.replayed({.time = 1.001, .key = 66, .down = true});
    session.recorder.replayed({.time = 1.499, .key = 66, .down = false});
    session.draw(1.25 + 0.249);
    const std::span<const Event> events = session.recorder.events();
    ASSERT_EQ(events.size(), 3u);
    EXPECT_EQ(events[0].time, 1.001);
    EXPECT_EQ(events[1].key, 65) << "stamped 1.49";
    EXPECT_EQ(events[2].time, 1.499);
}

TEST(Recorder, WhatIsForgottenIsStillTheStateOfLater) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        std::mt19937 random(seed);
        Session session;
        session.recorder.start(kBefore, session.input);
        for (int k = 0; k < 100; ++k) {
            for (auto n = random() % 4; n > 0; --n) do_something(session, random);
            session.draw(0.04 * k);
        }
        const std::span<const Event> all = session.recorder.events();
        const std::vector<Event> whole(all.begin(), all.end());
        session.recorder.forget_before(3.0);
        const std::span<const Event> rest = session.recorder.events();
        EXPECT_LT(rest.size(), whole.size());
        for (double from = 3.0; from < 4.0; from += 1.0 / 240) {
            const double to = from + 1.0 / 240;
            ASSERT_EQ(replay(rest, from, to, kSize), replay(whole, from, to, kSize))
                << seed << " at " << from;
        }
    }
}

TEST(Recorder, WhatHappensInAPauseIsSeenWhenTimeGoesOn) {
    Session session;
    session.recorder.start(kBefore, session.input);
    session.draw(1.0);
    session.key(65, true);
    session.draw(1.0);
    session.draw(1.25);
    const std::span<const Event> events = session.recorder.events();
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].time, 1.25);
}

TEST(Recorder, WhatHappensInAPauseIsKeptWhereRecordingEndsInIt) {
    Session session;
    session.recorder.start(kBefore, session.input);
    session.draw(1.0);
    session.key(65, true);
    session.key(65, false);
    session.draw(1.0);
    session.key(66, true);  // which no frame has seen
    const std::vector<Event> events = session.recorder.stop();
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[0].key, 65);
    EXPECT_GT(events[0].time, 1.0);
    EXPECT_LT(events[1].time, 1.1);
}

TEST(Recorder, WhatIsHeldWhereRecordingEndsIsLetGoBehindIt) {
    Session session;
    session.recorder.start(0.0, session.input);
    session.recorder.replayed({.time = 0.5, .key = 67, .down = true});  // to be let go by its own
    session.key(66, true);
    session.mouse({0.25, 0.5}, true);
    session.draw(1.0);
    session.key(68, true);  // seen by no frame
    const std::vector<Event> events = session.recorder.stop();
    ASSERT_EQ(events.size(), 5u);
    for (std::size_t i = 3; i < 5; ++i) {
        EXPECT_GT(events[i].time, 1.0);
        EXPECT_FALSE(events[i].down);
    }
    EXPECT_EQ(events[3].key, 66);
    EXPECT_EQ(events[4].mouse, glm::dvec2(0.25, 0.5));
}

TEST(Recorder, WhatWasDoneBeforeTimeWentBackIsHandedOut) {
    Session session;
    session.recorder.start(0.0, session.input);
    session.key(66, true);
    session.draw(1.0);
    session.draw(0.0);
    session.key(67, true);
    session.draw(0.1);
    EXPECT_EQ(session.recorder.end(), 1.0);
    const std::vector<Event> events = session.recorder.stop();
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[0].key, 66);
    EXPECT_FALSE(events[1].down);
}

TEST(Recorder, OfTheStateAtTheStartOnlyWhatIsReadIsSaid) {
    InputState state;
    state.key(65, true);
    state.mouse({0.25, 0.5}, true);
    for (const InputReads reads :
         {InputReads{true, true}, {true, false}, {false, true}, {false, false}}) {
        Recorder recorder;
        recorder.start(0.0, state, {}, reads);
        for (const Event& event : recorder.events())
            EXPECT_TRUE(event.key >= 0 ? reads.keys : reads.mouse);
        EXPECT_EQ(recorder.events().empty(), !reads.keys && !reads.mouse);
    }
}

TEST(Recorder, EndsWhenTimeGoesBack) {
    Session session;
    session.recorder.start(kBefore, session.input);
    session.key(65, true);
    session.draw(2.0);
    session.key(66, true);
    session.draw(1.0);
    EXPECT_FALSE(session.recorder.recording());
    session.key(67, true);
    session.draw(3.0);
    EXPECT_EQ(session.recorder.stop().size(), 2u) << "it is let go";
    EXPECT_TRUE(session.recorder.stop().empty());
}

TEST(Recorder, RecordsNothingUnlessItWasStarted) {
    Session session;
    session.key(65, true);
    session.mouse({0.5, 0.5}, true);
    session.draw(1.0);
    EXPECT_TRUE(session.recorder.stop().empty());
}

}  // namespace
}  // namespace glint::recording_test
