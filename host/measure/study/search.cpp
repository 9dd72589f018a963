#include "measure/study/search.h"

#include "measure/study/result.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace glint {
namespace {

constexpr std::size_t kPairs = 2;  // that are tried at each place

// In factors, beyond or below.
double distance(const Tried& tried, const Budget& budget) {
    if (budget.ms) return std::abs(std::log(tried.ms / *budget.ms));
    return std::abs(std::log(std::max(tried.error, kLeastRmse) /
                             std::max(budget.error.value_or(0.0), kLeastRmse)));
}

bool is_within(const Tried& tried, const Budget& budget) {
    return (!budget.ms || tried.ms <= *budget.ms) &&
           (!budget.error || tried.error <= *budget.error);
}

std::vector<Tried> frontier(std::span<const Tried> tried) {
    std::vector<Tried> best;
    for (const Tried& one : tried) {
        const bool beaten = std::ranges::any_of(tried, [&](const Tried& other) {
            const bool as_good = other.ms <= one.ms && other.error <= one.error;
            return as_good && (other.ms < one.ms || other.error < one.error);
        });
        if (!beaten) best.push_back(one);
    }
    return best;
}

class Search {
public:
    Search(const std::vector<Dial>& dials, const Budget& budget, int tries,
           const std::function<std::optional<Tried>(const Stand&)>& measure)
        : dials_(dials), budget_(budget), left_(tries), measure_(measure) {}

    // False where no more may be measured.
    bool add(const Stand& at) {
        if (known_.contains(at)) return true;
        if (left_-- <= 0) return false;
        const auto tried = measure_(at);
        if (!tried) return false;
        known_[at] = tried_.size();
        tried_.push_back(*tried);
        return true;
    }

    // Each number as far down as the error stays within `most`, those first that save most alone;
    // false where no more may be measured.
    bool descend(Stand at, double most) {
        std::vector<std::pair<double, std::size_t>> order;  // ms of the least of a number alone
        for (std::size_t d = 0; d < dials_.size(); ++d) {
            const auto least = dials_[d].is_menu ? at : least_within(at, d, most);
            if (!least) return false;
            if (*least != at) order.emplace_back(tried(*least).ms, d);
        }
        std::ranges::sort(order);
        for (const auto& [ms, dial] : order) {
            const auto least = least_within(at, dial, most);
            if (!least) return false;
            at = *least;
        }
        return true;
    }

    // Of each menu the choice with the least error; false where no more may be measured.
    bool turn_menus(Stand& at) {
        for (std::size_t d = 0; d < dials_.size(); ++d) {
            for (std::size_t v = 0; dials_[d].is_menu && v < dials_[d].count; ++v) {
                Stand turned = at;
                turned[d] = v;
                if (!add(turned)) return false;
                if (tried(turned).error < tried(at).error) at = turned;
            }
        }
        return true;
    }

    const Tried& tried(const Stand& at) const { return tried_[known_.at(at)]; }

    void run() {
        while (const auto place = next_place())
            if (!look_round(tried_[*place])) return;
    }

    std::vector<Tried> take() { return std::move(tried_); }

private:
    // The least value of one number with an error of at most so much, by bisection: an error grows
    // as the work goes down. Nothing where no more may be measured.
    std::optional<Stand> least_within(Stand at, std::size_t dial, double most) {
        std::size_t below = 0;  // not known to be within
        for (std::size_t within = at[dial]; below < within;) {
            Stand middle = at;
            middle[dial] = std::midpoint(below, within);
            if (!add(middle)) return std::nullopt;
            if (tried(middle).error <= most) {
                within = middle[dial];
                at = middle;
            } else {
                below = middle[dial] + 1;
            }
        }
        return at;
    }

    std::optional<std::size_t> next_place() const {
        std::optional<std::size_t> next;
        for (const Tried& one : frontier(tried_)) {
            const std::size_t place = known_.at(one.at);
            if (looked_.contains(one.at)) continue;
            if (!next || distance(one, budget_) < distance(tried_[*next], budget_)) next = place;
        }
        return next;
    }

    std::vector<Stand> neighbours(const Stand& at) const {
        std::vector<Stand> list;
        for (std::size_t d = 0; d < dials_.size(); ++d) {
            for (std::size_t v = 0; v < dials_[d].count; ++v) {
                const bool near = v + 1 == at[d] || v == at[d] + 1;
                if (v == at[d] || (!dials_[d].is_menu && !near)) continue;
                list.push_back(at);
                list.back()[d] = v;
            }
        }
        return list;
    }

    bool look_round(Tried place) {
        looked_.insert(place.at);
        const std::vector<Stand> list = neighbours(place.at);
        for (const Stand& at : list)
            if (!add(at)) return false;
        for (const Stand& at : promising_pairs(place, list))
            if (!add(at)) return false;
        return true;
    }

    // Two steps at once, as they would come out if times added up, and squares of errors.
    std::vector<Stand> promising_pairs(const Tried& place, const std::vector<Stand>& list) const {
        std::vector<Tried> promised;
        for (std::size_t i = 0; i < list.size(); ++i) {
            for (std::size_t k = i + 1; k < list.size(); ++k) {
                Tried both{.at = list[i]};
                std::size_t turned = 0;
                for (std::size_t d = 0; d < dials_.size(); ++d) {
                    if (list[k][d] != place.at[d]) both.at[d] = list[k][d];
                    turned += both.at[d] != place.at[d];
                }
                if (turned < 2 || known_.contains(both.at)) continue;
                const Tried &a = tried_[known_.at(list[i])], &b = tried_[known_.at(list[k])];
                both.ms = a.ms + b.ms - place.ms;
                both.error = std::sqrt(std::max(
                    a.error * a.error + b.error * b.error - place.error * place.error, 0.0));
                if (is_within(both, budget_)) promised.push_back(std::move(both));
            }
        }
        std::ranges::stable_sort(promised, [&](const Tried& a, const Tried& b) {
            return budget_.ms ? a.error < b.error : a.ms < b.ms;
        });
        std::vector<Stand> best;
        for (std::size_t i = 0; i < std::min(kPairs, promised.size()); ++i)
            best.push_back(promised[i].at);
        return best;
    }

    const std::vector<Dial>& dials_;
    const Budget& budget_;
    int left_;
    const std::function<std::optional<Tried>(const Stand&)>& measure_;
    std::vector<Tried> tried_;
    std::map<Stand, std::size_t> known_;  // where it stands in tried_
    std::set<Stand> looked_;              // whose neighbours are known
};

}  // namespace

std::vector<Tried> search(const std::vector<Dial>& dials, const Stand& own, const Budget& budget,
                          int tries,
                          const std::function<std::optional<Tried>(const Stand&)>& measure) {
    Search search(dials, budget, tries, measure);
    if (!search.add(own)) return search.take();
    const double most = budget.error.value_or(kAsGood * search.tried(own).error);
    Stand from = own;
    if (search.tried(own).error > most) {  // no single step may come nearer, and all at once do
        for (std::size_t d = 0; d < dials.size(); ++d)
            if (!dials[d].is_menu) from[d] = dials[d].count - 1;
        if (!search.add(from)) return search.take();
        if (search.tried(from).error > most && !search.turn_menus(from)) return search.take();
        if (search.tried(from).error > most) from = own;
    }
    // From two sides: what stands, and the least of all.
    if (search.descend(from, most) && search.add(Stand(dials.size(), 0))) search.run();
    return search.take();
}

std::vector<Tried> best_of(std::span<const Tried> tried, const Budget& budget, std::size_t most) {
    std::vector<Tried> best = frontier(tried);
    std::ranges::stable_sort(best, [&](const Tried& a, const Tried& b) {
        return distance(a, budget) < distance(b, budget);
    });
    if (best.size() > most) best.resize(most);
    std::ranges::stable_sort(best, {}, &Tried::ms);
    return best;
}

}  // namespace glint
