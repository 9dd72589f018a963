// How far a reference is from the truth, and which rows stand beside it, by methods whose errors
// are known: pictures of numbers, without a driver.
#include "measure/study/result.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace glint::study_fall_test {
namespace {

constexpr int kPixels = 400;
using Picture = std::vector<double>;
using Method = std::function<double(int pixel, int work)>;

Picture picture(const Method& method, int work) {
    Picture result;
    for (int i = 0; i < kPixels; ++i) result.push_back(method(i, work));
    return result;
}

double apart(const Picture& a, const Picture& b) {
    double sum = 0.0;
    for (int i = 0; i < kPixels; ++i) sum += std::pow(a[i] - b[i], 2.0);
    return std::sqrt(sum / kPixels);
}

// Each frame of a row took so long, ms.
FrameTimes steady(double ms) {
    FrameTimes times;
    for (int i = 0; i < 40; ++i) {
        const double jitter = ms * (1.0 + 0.001 * (i % 7));
        times.wall.push_back(jitter);
        times.processor.push_back(jitter);
    }
    times.gpu = times.wall;
    return times;
}

// Rows of these, beside a reference that twice its work measures. `ms` of a row by its work.
Study judged(
    const Method& method, const std::vector<int>& works, int reference,
    const std::function<double(int)>& ms = [](int work) { return 1.0 + 0.1 * work; },
    double size = 1.0) {
    const Picture truth = picture(method, reference);
    Study study{.reference = std::to_string(reference), .second = "twice"};
    study.reference_size = size;
    std::vector<Picture> pictures;
    for (const int work : works) {
        pictures.push_back(picture(method, work));
        StudyRow row{.value = std::to_string(work), .work = work, .times = steady(ms(work))};
        row.error = Difference{.rmse = apart(pictures.back(), truth), .max = 1.0};
        row.is_reference = work == reference;
        if (std::isnan(row.error->rmse)) row.failed = "diverged";
        study.rows.push_back(row);
    }
    for (StudyRow& row : study.rows)
        for (const Picture& other : pictures)
            row.apart.push_back(apart(pictures[&row - study.rows.data()], other));
    study.reference_error = Difference{.rmse = apart(picture(method, 2 * reference), truth)};
    KnobValue value{.text = study.reference, .work = reference};
    judge(study, {.reference = value, .second_work = kTwiceTheWork}, true);
    return study;
}

const std::vector<int> kDoubled = {4, 8, 16, 32, 64, 128, 256};

// error = shape(pixel) / work^order, nothing random.
Method of_order(double order) {
    return [order](int pixel, int work) { return (0.5 + 0.001 * pixel) * std::pow(work, -order); };
}

// A mean of `work` random numbers, which more work goes on with.
double mean_of_samples(int pixel, int work) {
    std::mt19937 random(static_cast<unsigned>(pixel) + 1);
    std::normal_distribution<double> normal;
    double sum = 0.0;
    for (int i = 0; i < work; ++i) sum += normal(random);
    return sum / work;
}

double off_truth(const Method& method, int work) {
    return apart(picture(method, work), Picture(kPixels, 0.0));
}

TEST(StudyFall, TellsSlowMethodsFromRandomOnesOfTheSameOrder) {
    // To a tenth: 0.93 to 1.00 were measured.
    for (const double order : {0.4, 0.5, 0.6, 1.0, 2.0}) {
        const Method method = of_order(order);
        const double ratio = judged(method, kDoubled, 1024).own_error / off_truth(method, 1024);
        EXPECT_NEAR(ratio, 1.0, 0.1) << "order " << order;
    }
    const double ratio =
        judged(mean_of_samples, kDoubled, 1024).own_error / off_truth(mean_of_samples, 1024);
    EXPECT_NEAR(ratio, 1.0, 0.1) << "random samples";
}

TEST(StudyFall, TellsASumThatNeverEnds) {
    const Method harmonic = [](int pixel, int work) {
        double sum = 0.0;
        for (int i = 1; i <= work; ++i) sum += 1.0 / i;
        return sum * (0.5 + 0.001 * pixel);
    };
    const Study study = judged(harmonic, kDoubled, 1024);
    EXPECT_FALSE(study.converges);
    ASSERT_FALSE(study.findings.empty());
    EXPECT_NE(study.findings[0].find("does not converge"), std::string::npos);
    for (const StudyRow& row : study.rows) EXPECT_FALSE(row.pareto) << row.value;
    EXPECT_FALSE(judged(harmonic, kDoubled, 64).converges) << "rows of less work tell it";
    const Method halved = [](int pixel, int work) { return (0.5 + 0.001 * pixel) / work; };
    EXPECT_TRUE(judged(halved, kDoubled, 64).converges) << "of rows beyond it nothing is known";
    // A reference that leads away by itself, as a sum of too many floats does.
    const Method worn = [](int pixel, int work) {
        return (0.5 + 0.001 * pixel) * (1.0 / (work * work) + 1e-9 * work * work);
    };
    for (const std::string& finding : judged(worn, kDoubled, 60000).findings)
        EXPECT_EQ(finding.find("the rows are as far"), std::string::npos) << finding;
    // One whose steps become shorter, however slowly, has an end.
    EXPECT_TRUE(judged(of_order(0.3), kDoubled, 1024).converges);
}

// Of a picture that is no number nothing is known, neither of the rows beside it.
TEST(StudyFall, IsToldAcrossARowThatDiverged) {
    const auto broken_at = [](int work_of_none, const Method& method) -> Method {
        return [=](int pixel, int work) {
            return work == work_of_none ? std::nan("") : method(pixel, work);
        };
    };
    const Method harmonic = [](int pixel, int work) {
        double sum = 0.0;
        for (int i = 1; i <= work; ++i) sum += 1.0 / i;
        return sum * (0.5 + 0.001 * pixel);
    };
    for (const int work : {4, 16, 128, 256}) {
        EXPECT_FALSE(judged(broken_at(work, harmonic), kDoubled, 1024).converges) << work;
        const Study sound = judged(broken_at(work, of_order(1.0)), kDoubled, 1024);
        ASSERT_EQ(sound.findings.size(), 1u) << sound.findings.front();
        EXPECT_EQ(sound.findings[0], std::to_string(work) + ": diverged");
    }
}

// Of one that falls faster the more work is done, as Jacobi's sweeps make it, early steps grow.
TEST(StudyFall, OfAnErrorThatFallsExponentiallyHasAnEnd) {
    const Method sweeps = [](int pixel, int work) {
        return std::exp(-work / 200.0) * (0.5 + 0.001 * pixel);
    };
    const Study study = judged(sweeps, {1, 2, 4, 8, 16, 32, 64, 128, 256}, 1024);
    EXPECT_TRUE(study.converges);
    EXPECT_TRUE(study.findings.empty()) << study.findings.front();
    const double off = off_truth(sweeps, 1024);
    EXPECT_GE(study.own_error, off);
    EXPECT_LT(study.own_error, 2.0 * off) << "by the order at the reference, and not of the rows";
}

// The first is near by chance, as one sample in the middle is.
TEST(StudyFall, GrowsNotWhereTheLastComeNearer) {
    const Method lucky = [](int pixel, int work) {
        return work == 1 ? 0.0014 : of_order(1.0)(pixel, work) * 0.05;
    };
    const Study study = judged(lucky, {1, 2, 4}, 1024);
    EXPECT_TRUE(study.converges);
    EXPECT_TRUE(study.findings.empty()) << study.findings.front();
    const Method worse = [](int, int work) { return work == 8 ? 0.39 : 0.1 * work; };
    EXPECT_FALSE(judged([&](int pixel, int work) { return work > 8 ? 0.0 : worse(pixel, work); },
                        {1, 2, 4, 8}, 1024)
                     .converges)
        << "the last is as far as the one before";
}

// Small values have small errors, and a sum of floats has rounding, which goes nowhere.
TEST(StudyFall, IsToldBesideTheSizeOfValues) {
    const auto ms = [](int work) { return 1.0 + 0.1 * work; };
    const Method tiny = [](int pixel, int work) {
        double sum = 0.0;
        for (int i = 1; i <= work; ++i) sum += 1e-12 / i;
        return sum * (0.5 + 0.001 * pixel);
    };
    EXPECT_FALSE(judged(tiny, kDoubled, 1024, ms, 1e-11).converges);
    const Method small = [](int pixel, int work) { return 1e-9 * of_order(1.0)(pixel, work); };
    const Study fallen = judged(small, kDoubled, 1024, ms, 1e-8);
    ASSERT_TRUE(fallen.order);
    EXPECT_NEAR(*fallen.order, 1.0, 0.1);
    const Method rounded = [](int pixel, int work) {
        float sum = 0.0f;
        for (int i = 0; i < work; ++i)
            sum += (0.3f + 0.001f * static_cast<float>(pixel)) / static_cast<float>(work);
        return static_cast<double>(sum);
    };
    const Study study = judged(rounded, {3, 5, 6, 12, 24, 48, 96, 100}, 700, ms, 0.7);
    EXPECT_TRUE(study.converges);
    EXPECT_TRUE(study.findings.empty()) << study.findings.front();
}

TEST(StudyFall, MakesNoReferenceWrongThatIsNone) {
    struct {
        Method method;
        std::vector<int> works;
        int reference;
    } const cases[] = {
        {of_order(1.0), {16, 17}, 4096},
        {of_order(1.0), {8, 8}, 4096},
        // A text that uses every fourth.
        {[](int pixel, int work) { return of_order(1.0)(pixel, std::max(1, work / 4)); },
         {61, 62, 63},
         4096},
        {[](int pixel, int work) { return of_order(1.0)(pixel, std::max(1, work / 4)); },
         {4, 5, 8, 9, 16, 17, 32, 33},
         4096},
        // Unstable at first.
        {[](int pixel, int work) {
             return work == 1 ? 800.0 : work == 2 ? 0.8 : of_order(4.9)(pixel, work) * 0.03;
         },
         {1, 2, 4, 8},
         16},
        // A series whose terms grow before they fall.
        {[](int, int work) { return std::pow(5.0, work) / std::tgamma(1.0 + work); },
         {1, 2, 3, 4, 5, 6, 7, 8, 9, 10},
         24},
    };
    for (const auto& one : cases) {
        const Study study = judged(one.method, one.works, one.reference);
        EXPECT_TRUE(study.findings.empty())
            << one.works.size() << " rows: " << study.findings.front();
    }
    const Method method = [](int pixel, int work) {
        return work == 4096 || work == 8192 ? 7.0 : of_order(1.0)(pixel, work);
    };
    const Study wrong = judged(method, {8, 16, 32, 64}, 4096);
    ASSERT_FALSE(wrong.findings.empty());
    EXPECT_NE(wrong.findings[0].find("the reference is wrong"), std::string::npos);
}

TEST(StudyFall, IsTheSameWhicheverEndOfAListStandsFirst) {
    std::vector<int> falling = kDoubled;
    std::ranges::reverse(falling);
    const Study up = judged(of_order(2.0), kDoubled, 1024);
    const Study down = judged(of_order(2.0), falling, 1024);
    EXPECT_TRUE(up.findings.empty());
    EXPECT_TRUE(down.findings.empty());
    EXPECT_DOUBLE_EQ(up.own_error, down.own_error);
}

// What cannot be told from the truth has no star, and whatever takes longer and is farther has
// none beside it.
TEST(StudyStars, AreNotOfRowsThatTheTruthItselfIsFasterThan) {
    const auto dearer_when_coarse = [](int work) { return work == 1024 ? 1.0 : 2.0 + work; };
    std::vector<int> works = kDoubled;
    works.push_back(1024);
    for (const StudyRow& row : judged(of_order(1.0), works, 1024, dearer_when_coarse).rows)
        EXPECT_FALSE(row.pareto) << row.value;
    const Study usual = judged(of_order(1.0), works, 1024);
    for (const StudyRow& row : usual.rows) EXPECT_EQ(row.pareto, !row.is_reference) << row.value;
}

}  // namespace
}  // namespace glint::study_fall_test
