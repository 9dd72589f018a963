#include "measure/study/search.h"

#include "measure/study/result.h"

#include <algorithm>
#include <cmath>
#include <map>
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

    void run() {
        while (const auto place = next_place())
            if (!look_round(tried_[*place])) return;
    }

    std::vector<Tried> take() { return std::move(tried_); }

private:
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
    // From two sides: what stands, and the least of all.
    if (search.add(own) && search.add(Stand(dials.size(), 0))) search.run();
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
