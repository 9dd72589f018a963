// Bars that the scenes are held to (Q1 to Q22 in bars.md): the worst of many cases, and where.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace glint {

// The worst of what it sees, and where that was. What is no number is the worst.
class Worst {
public:
    enum class Side { at_most, at_least };

    explicit Worst(double limit, Side side = Side::at_most) : limit_(limit), side_(side) {}

    void see(double value, std::string_view where) {
        ++cases_;
        failed_ += !holds(value);
        nearest_ = std::min(nearest_, distance(value));
        const bool worse = side_ == Side::at_most ? !(value <= worst_) : !(value >= worst_);
        if (cases_ > 1 && (std::isnan(worst_) || !worse)) return;
        worst_ = value;
        where_ = where;
        std::replace(where_.begin(), where_.end(), '\n', ' ');
    }
    double worst() const { return worst_; }
    // One of the same limit that has seen nothing.
    Worst unseen() const { return Worst(limit_, side_); }

    // The smaller, the worse was what it has seen since it was last asked, and never 0, so that a
    // search goes on from a case that fails to one that fails more; infinity where it saw nothing.
    float distance_since_asked() {
        return std::exchange(nearest_, std::numeric_limits<float>::infinity());
    }

protected:
    bool holds(double value) const {
        return side_ == Side::at_most ? value <= limit_ : value >= limit_;
    }

    double limit_;
    Side side_;
    double worst_ = 0.0;
    std::string where_;
    int cases_ = 0, failed_ = 0;

private:
    float distance(double value) const {
        const double beside = value / (limit_ == 0.0 ? 1.0 : limit_);
        return static_cast<float>(side_ == Side::at_most ? 1.0 / (1.0 + std::max(beside, 0.0))
                                                         : std::max(beside, 1e-6));
    }
    float nearest_ = std::numeric_limits<float>::infinity();
};

// Asserts at its end that its worst case is within the limit, and keeps that case with the test's
// results, from which tests/fragments/bars writes its table.
class Bar : public Worst {
public:
    // name: the bar, the scene, what is measured and in which unit: "Q11 sea: rays off, %".
    Bar(std::string name, double limit, Side side = Side::at_most)
        : Worst(limit, side), name_(std::move(name)) {}
    Bar(const Bar&) = delete;
    Bar& operator=(const Bar&) = delete;

    ~Bar() {
        const char* sign = side_ == Side::at_most ? "<=" : ">=";
        fmt::print("{}: {:.4g} {} {:.4g} at worst of {}: {}\n", name_, worst_, sign, limit_, cases_,
                   where_);
        testing::Test::RecordProperty(
            name_, fmt::format("{:.4g}|{}|{:.4g}|{}|{}", worst_, sign, limit_, cases_, where_));
        EXPECT_GT(cases_, 0) << name_ << ": nothing was seen";
        EXPECT_TRUE(holds(worst_)) << name_ << ": " << worst_ << " (" << sign << " " << limit_
                                   << ") at " << where_ << "; in " << failed_ << " of " << cases_;
    }

private:
    std::string name_;
};

}  // namespace glint
