// Which joint setting of several quality tweaks is the best within a budget: a search over measured
// costs and gains. It knows no scene.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace glint {

// Where the tweaks stand together: for each the index of its value.
using Stand = std::vector<std::size_t>;

struct Dial {
    std::size_t count = 0;  // of values, from the least work to the most
    bool is_menu = false;   // whose values have no order
};

struct Tried {
    Stand at;
    double ms = 0.0, error = 0.0;
};

// At most so many milliseconds, or at most this error; one of the two.
struct Budget {
    std::optional<double> ms, error;
};

constexpr double kAsGood = 1.01;  // times an error: nobody would tell

// First down from `own`, or, where that is not within the budget, from the most work of all, as far
// as nobody would tell, or as the budget allows: what one tweak is off hides what others are. Then
// goes on from what is measured: of the best that stand nearest to the budget the one whose
// neighbours are not known yet gets them measured, and the pairs of them that promise most
// together, until nothing is left or `measure` has been called so often, or says that it is enough
// (nothing).
std::vector<Tried> search(const std::vector<Dial>& dials, const Stand& own, const Budget& budget,
                          int tries,
                          const std::function<std::optional<Tried>(const Stand&)>& measure);

// Those that nothing beats in both, at most so many, the nearest to the budget; the fastest first.
std::vector<Tried> best_of(std::span<const Tried> tried, const Budget& budget, std::size_t most);

}  // namespace glint
