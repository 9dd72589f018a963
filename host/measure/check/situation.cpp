#include "measure/check/situation.h"

#include "measure/check/keys.h"
#include "measure/check/space.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {
namespace {

constexpr std::size_t kMostHeld = 6;

// What the text names, or where it names none, what most texts mean.
std::vector<int> keys_to_hold(const CheckSubject& subject) {
    if (!subject.renderer().reads_keyboard()) return {};
    std::vector<int> keys = keys_named(subject.scene().text);
    if (keys.empty()) keys = keys_in_order();
    keys.resize(std::min(keys.size(), kMostHeld));
    return keys;
}

}  // namespace

void Situation::bring(CheckSubject& subject) const {
    subject.restore();
    subject.preset.values = values;
    subject.preset.events = events;
    subject.preset.date = date;
}

std::vector<Situation> situations(CheckSubject& subject, std::size_t ends, int spread) {
    std::vector<Situation> all;
    const Preset& opened = subject.opened();
    for (auto& values : values_at_ends(subject, subject.specialised() ? 1 : ends))
        all.push_back({std::move(values), opened.events, opened.time, opened.date});
    const Space space(subject, keys_to_hold(subject));
    const auto add = [&](const Point& point) {
        subject.restore();
        const double time = space.apply(point, subject);
        all.push_back({subject.preset.values, subject.preset.events, time, subject.preset.date});
    };
    for (const Point& point : space.inputs()) add(point);
    if (!subject.specialised() && spread > 0) {
        for (const Point& point : space.zeros()) add(point);
        // At the preset's size, which is dear to change.
        Search search(space.usual(), space.rare());
        const std::size_t often = space.usual().size() - space.rare();
        for (int k = 0; k < spread && often > 0; ++k) {
            Point point = search.spread_point();
            std::copy(space.usual().begin() + static_cast<std::ptrdiff_t>(often),
                      space.usual().end(), point.begin() + static_cast<std::ptrdiff_t>(often));
            add(point);
        }
    }
    subject.restore();
    return all;
}

bool reads_a_clock(std::string_view text) {
    constexpr std::string_view kClocks[] = {"iTime", "iTick", "iFrame"};
    return std::ranges::any_of(kClocks,
                               [&](std::string_view name) { return text.find(name) != text.npos; });
}

std::string where_words(const Situation& situation, const CheckSubject& subject) {
    std::string words;
    const auto add = [&](const std::string& word) {
        words += (words.empty() ? "; at " : ", ") + word;
    };
    const Preset& opened = subject.opened();
    for (std::size_t i = 0; i < situation.values.size(); ++i) {
        const Tweak& tweak = opened.scene.tweaks[i];
        if (situation.values[i] != opened.values[i])
            add(tweak.name + "=" + format_value(tweak, situation.values[i]));
    }
    if (situation.time != opened.time) add(fmt::format("time {:.4g}", situation.time));
    if (situation.date != opened.date) add("date " + date_words(situation.date));
    if (situation.events == opened.events) return words;
    const Event* mouse = nullptr;  // where it is in the end
    for (const Event& event : situation.events) {
        if (event.key < 0)
            mouse = &event;
        else
            add("key " + key_name(event.key));
    }
    if (mouse)
        add(fmt::format("mouse {:.3g},{:.3g}{}", mouse->mouse.x, mouse->mouse.y,
                        mouse->down ? "" : " released"));
    return words;
}

}  // namespace glint
