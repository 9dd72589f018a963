// The search over joint settings, on costs and errors that are known.
#include "measure/study/joint.h"
#include "measure/study/search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace glint {
namespace {

// Tweaks whose times add up, and squares of whose errors do, each with a rate of its own.
struct World {
    std::vector<double> cost, error, order;

    Tried at(const Stand& stand) const {
        double ms = 1.0, squares = 0.0;
        for (std::size_t i = 0; i < stand.size(); ++i) {
            const double work = std::pow(2.0, static_cast<double>(stand[i]));
            ms += cost[i] * work;
            squares += std::pow(error[i] * std::pow(work, -order[i]), 2.0);
        }
        return {.at = stand, .ms = ms, .error = std::sqrt(squares)};
    }
};

World world(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    World result;
    for (int i = 0; i < 4; ++i) {
        result.cost.push_back(std::pow(10.0, between(-2.0, 0.0)));
        result.error.push_back(std::pow(10.0, between(-2.0, 0.0)));
        result.order.push_back(between(0.5, 2.0));
    }
    return result;
}

const std::vector<Dial> kDials(4, Dial{.count = 7});

Tried best_within(const std::vector<Tried>& all, const Budget& budget) {
    Tried best{.at = {}, .ms = 1e9, .error = 1e9};
    for (const Tried& one : all) {
        if (budget.ms && one.ms <= *budget.ms && one.error < best.error) best = one;
        if (budget.error && one.error <= *budget.error && one.ms < best.ms) best = one;
    }
    return best;
}

std::vector<Tried> everything(const World& known) {
    std::vector<Tried> all;
    for (std::size_t i = 0; i < 7 * 7 * 7 * 7; ++i)
        all.push_back(known.at({i % 7, i / 7 % 7, i / 49 % 7, i / 343}));
    return all;
}

// Of 2401 settings 160 are measured; where they stand about the budget, nothing much better is
// left.
TEST(StudySearch, FindsWhatAllSettingsTogetherHave) {
    int exact = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const World known = world(seed);
        const auto measure = [&](const Stand& at) { return std::optional(known.at(at)); };
        const Stand own = {3, 3, 3, 3};
        for (const Budget& budget : {Budget{.ms = known.at(own).ms, .error = {}},
                                     Budget{.ms = {}, .error = known.at(own).error}}) {
            const auto tried = search(kDials, own, budget, 160, measure);
            EXPECT_LE(tried.size(), 160u);
            const Tried found = best_within(tried, budget);
            const Tried truth = best_within(everything(known), budget);
            exact += found.at == truth.at;
            EXPECT_LE(budget.ms ? found.error / truth.error : found.ms / truth.ms, 1.1) << seed;
        }
    }
    EXPECT_GE(exact, 60) << "of 80";
}

// Two methods: one is good for nothing until its steps are many, and then the better one.
TEST(StudySearch, ComesToAnotherMethod) {
    const auto measure = [](const Stand& at) {
        const double steps = std::pow(2.0, static_cast<double>(at[1]));
        const bool other = at[0] == 1;
        return std::optional(Tried{.at = at,
                                   .ms = 1.0 + (other ? 0.5 : 1.0) * steps,
                                   .error = other ? 2.0 / (steps * steps) : 0.5 / steps});
    };
    const std::vector<Dial> dials = {{.count = 2, .is_menu = true}, {.count = 7}};
    const auto tried = search(dials, {0, 2}, {.ms = 9.0, .error = {}}, 160, measure);
    EXPECT_EQ(best_within(tried, {.ms = 9.0, .error = {}}).at, (Stand{1, 4}));
}

// One number has nearly all the error and is dear; six others have next to none, and take most of
// the time. None of them alone is worth a step, by what the error says of it.
struct Hidden {
    std::mt19937_64 random{7};
    double noise = 0.0;  // of a time, as a share of it
    static constexpr std::size_t kTop = 6;

    Tried operator()(const Stand& at) {
        double ms = 20.0 * std::pow(2.0, static_cast<double>(at[0]));
        double squares = std::pow(0.1 / std::pow(2.0, static_cast<double>(at[0])), 2.0);
        for (std::size_t i = 1; i < at.size(); ++i) {
            const double work = std::pow(2.0, static_cast<double>(at[i]));
            ms += 0.1 * work;
            squares += std::pow(0.05 / (work * work), 2.0);
        }
        const double wavers = noise * (2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1.0);
        return {.at = at, .ms = ms * (1.0 + wavers), .error = std::sqrt(squares)};
    }
};

TEST(StudySearch, GoesDownWhereWhatOneIsOffHidesTheOthers) {
    const std::vector<Dial> dials(7, Dial{.count = 7});
    const Stand own = {0, 6, 6, 6, 6, 6, 6};
    for (const double noise : {0.0, 0.05}) {
        Hidden known{.noise = noise};
        const double error = 1.01 * known(own).error;
        const auto tried = search(dials, own, {.ms = {}, .error = error}, 60,
                                  [&](const Stand& at) { return std::optional(known(at)); });
        const Tried best = best_within(tried, {.ms = {}, .error = error});
        Hidden exact;
        EXPECT_LT(exact(best.at).ms, 0.5 * exact(own).ms) << "noise " << noise;
    }
}

// The error is that of the coarsest: one of them alone, or two of three, change nothing.
TEST(StudySearch, FindsWhatOnlyAllTogetherReach) {
    const std::vector<Dial> dials(3, Dial{.count = 7});
    const auto measure = [](const Stand& at) {
        double ms = 0.0;
        for (const std::size_t v : at) ms += std::pow(2.0, static_cast<double>(v));
        const auto least = static_cast<double>(std::ranges::min(at));
        return std::optional(Tried{.at = at, .ms = ms, .error = std::pow(2.0, -least)});
    };
    const Budget budget{.ms = {}, .error = std::pow(2.0, -5.0)};
    const auto tried = search(dials, {2, 2, 2}, budget, 60, measure);
    EXPECT_EQ(best_within(tried, budget).at, (Stand{5, 5, 5}));
}

// A switch has most of the error, and six numbers the rest: neither alone reaches it.
TEST(StudySearch, TurnsMenusWhereNumbersAloneDoNotReach) {
    std::vector<Dial> dials(7, Dial{.count = 9});
    dials[0] = {.count = 2, .is_menu = true};
    const auto measure = [](const Stand& at) {
        double ms = 1.0, error = at[0] == 1 ? 0.0 : 0.05;
        for (std::size_t d = 1; d < at.size(); ++d) {
            ms += std::pow(2.0, static_cast<double>(at[d]));
            error += 0.03 * std::pow(0.5, static_cast<double>(at[d]));
        }
        return std::optional(Tried{.at = at, .ms = ms, .error = error});
    };
    const Budget budget{.ms = {}, .error = 0.006};
    const auto tried = search(dials, Stand(7, 0), budget, 160, measure);
    const Tried best = best_within(tried, budget);
    EXPECT_LE(best.error, 0.006);
    EXPECT_LE(best.ms, 1.5 * (1.0 + 6 * 32.0)) << "of 6 numbers of 32";
}

// Whatever is turned down costs error, and whatever is turned up costs time.
TEST(StudySearch, FindsNothingWhereThereIsNothing) {
    const std::vector<Dial> dials(3, Dial{.count = 7});
    const auto measure = [](const Stand& at) {
        double ms = 0.0, error = 0.0;
        for (const std::size_t v : at) {
            ms += std::pow(2.0, static_cast<double>(v));
            error += std::pow(4.0, -static_cast<double>(v));
        }
        return std::optional(Tried{.at = at, .ms = ms, .error = error});
    };
    const Stand own = {3, 3, 3};
    const double error = 1.01 * measure(own)->error;
    const auto tried = search(dials, own, {.ms = {}, .error = error}, 160, measure);
    EXPECT_EQ(best_within(tried, {.ms = {}, .error = error}).at, own);
}

TEST(StudySearch, EndsWhereNoMoreMayBeMeasured) {
    int left = 10;
    const World known = world(1);
    const auto tried = search(kDials, {3, 3, 3, 3}, {.ms = 5.0, .error = {}}, 160,
                              [&](const Stand& at) -> std::optional<Tried> {
                                  if (left-- == 0) return std::nullopt;
                                  return known.at(at);
                              });
    EXPECT_EQ(tried.size(), 10u);
}

TEST(StudySearch, KeepsTheBestAboutTheBudget) {
    const std::vector<Tried> tried = {{.at = {0}, .ms = 1.0, .error = 1.0},
                                      {.at = {1}, .ms = 2.0, .error = 0.5},
                                      {.at = {2}, .ms = 3.0, .error = 0.6},
                                      {.at = {3}, .ms = 4.0, .error = 0.1},
                                      {.at = {4}, .ms = 64.0, .error = 0.01}};
    const auto best = best_of(tried, {.ms = 4.0, .error = {}}, 2);
    ASSERT_EQ(best.size(), 2u);
    EXPECT_EQ(best[0].at, Stand{1}) << "the fastest first; what is beaten is left out";
    EXPECT_EQ(best[1].at, Stand{3});
}

StudyRow measured(const char* value, double ms, double rmse, double flip, TimeVerdict verdict) {
    StudyRow row{.value = value, .error = Difference{}, .verdict = verdict};
    row.ms.median = ms;
    row.error->rmse = rmse;
    row.error->flip = flip;
    return row;
}

// A machine that is so busy that nothing is told apart.
TEST(StudyBudget, OfThePresetsOwnTimeTakesNothingWhoseMedianIsLonger) {
    const auto busy = TimeVerdict::not_told_apart;
    Study study;
    study.rows = {measured("own", 75.0, 0.010, 0.020, busy),
                  measured("near", 76.5, 0.008, 0.018, busy),
                  measured("longer", 102.0, 0.004, 0.010, busy),
                  measured("seems farther", 70.0, 0.005, 0.030, busy),
                  measured("slower", 76.0, 0.003, 0.010, TimeVerdict::slower)};
    study.rows[0].is_preset = true;
    choose_best(study, {.of = Limit::Of::ms});
    ASSERT_TRUE(study.best);
    EXPECT_EQ(study.rows[*study.best].value, "near");
}

}  // namespace
}  // namespace glint
