// The chapter's Sec. 11, run again: what a right program reaches on readings of the same design.
// Bounds are those of a separate implementation (design notes, E1). Three seeds; all ten where
// TRUEPOSE_LONG is set.
#include "core/reproduce/section11.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace truepose {
namespace {

constexpr double kMm = 1e-3;

const Section11Result& Result() {
  static const auto* const kResult = [] {
    Section11Options options;
    if (std::getenv("TRUEPOSE_LONG") == nullptr) options.seeds = {1, 2, 3};
    // A second for each look at it.
    options.clock = [seconds = 0.0]() mutable { return seconds += 1.0; };
    auto result = Section11(options, {});
    if (!result.ok()) ADD_FAILURE() << result.status();
    return new Section11Result(result.ok() ? *std::move(result) : Section11Result{});
  }();
  return *kResult;
}

// Fits of one set of parameters by one estimator.
std::vector<const DimeFit*> Fits(const Section11Seed& seed, DimeSet set,
                                 const std::string& estimator) {
  std::vector<const DimeFit*> fits;
  for (const DimeFit& fit : seed.fits) {
    if (fit.set == set && fit.estimator == estimator) fits.push_back(&fit);
  }
  EXPECT_EQ(fits.size(), 3u) << estimator;
  return fits;
}

std::string Where(const Section11Seed& seed, int poses) {
  return "seed " + std::to_string(seed.seed) + ", " + std::to_string(poses) + " poses";
}

// The setting is the chapter's: before calibration 4.702 mm (0.02: noise of the readings), two
// operators 0.082 +- 0.015 mm apart with sd 0.062 +- 0.012. Would catch noise that is not that of
// the chapter, in which case no figure below would mean anything.
TEST(Section11, StandsWhereTheChapterStands) {
  for (const Section11Seed& seed : Result().seeds) {
    EXPECT_NEAR(seed.nominal.mean, 4.702 * kMm, 0.02 * kMm) << seed.seed;
    EXPECT_NEAR(seed.operators.difference_m.mean, 0.082 * kMm, 0.015 * kMm) << seed.seed;
    EXPECT_NEAR(seed.operators.difference_m.sd, 0.062 * kMm, 0.012 * kMm) << seed.seed;
    EXPECT_NEAR(seed.operators_iso.pooled_m, seed.operators.mean_plus_3_sd_m / 2, 0.001 * kMm);
  }
}

// Would catch a time that counts from the begin of all, or what another fit has taken.
TEST(Section11, TheTimeOfAFitIsItsOwn) {
  for (const Section11Seed& seed : Result().seeds) {
    for (const DimeFit& fit : seed.fits) EXPECT_EQ(fit.time_s, 1.0) << fit.estimator;
  }
}

// All 25 parameters by every estimator. Would catch a wrong Jacobian column, wrong weights, an
// estimator that stops early.
TEST(Section11, TwentyFiveParametersReachTheNoise) {
  for (const Section11Seed& seed : Result().seeds) {
    for (const DimeEstimator& estimator : DimeEstimators()) {
      const auto fits = Fits(seed, DimeSet::kComplete, estimator.name);
      for (size_t i = 0; i < fits.size(); ++i) {
        EXPECT_LE(fits[i]->control.mean, 0.11 * kMm)
            << estimator.name << ", " << Where(seed, fits[i]->calibration_poses);
        EXPECT_LE(fits[i]->control.mean, 1.25 * seed.splits[i].true_control.mean)
            << estimator.name << ", " << Where(seed, fits[i]->calibration_poses);
      }
    }
  }
}

// The 14 alone keep the model error of the other 11. Would catch a "reduced" fit that frees more.
TEST(Section11, FourteenParametersKeepAModelError) {
  for (const Section11Seed& seed : Result().seeds) {
    for (const DimeFit* fit : Fits(seed, DimeSet::kReduced, "levenberg_marquardt"))
      EXPECT_GT(fit->control.mean, 0.15 * kMm) << Where(seed, fit->calibration_poses);
  }
}

// 14 and what the 5 % rule adds. Would catch a rule that stops at once or takes the wrong ones.
TEST(Section11, SelectionReachesNearlyTheSame) {
  double sum = 0;
  int count = 0;
  for (const Section11Seed& seed : Result().seeds) {
    for (const DimeFit* fit : Fits(seed, DimeSet::kSelected, "levenberg_marquardt")) {
      EXPECT_LE(fit->control.mean, 0.20 * kMm) << Where(seed, fit->calibration_poses);
      EXPECT_FALSE(fit->added.empty());
      sum += fit->control.mean;
      ++count;
    }
  }
  EXPECT_LE(sum / count, 0.11 * kMm);
}

// Estimators that minimise the same cost, and how far above Levenberg-Marquardt's they may end: one
// pass of the filter linearises at every reading's own estimate (0.0002 to 2.6 % in E2, 3.4 % on
// the worst of these); the simplex stops at 1e-3.
struct Bound {
  std::string estimator;
  double cost_above;
};
const std::vector<Bound>& Bounds() {
  static const auto* const kBounds = new std::vector<Bound>{{"levenberg_marquardt", 0},
                                                            {"linear_iteration", 1e-9},
                                                            {"kalman, two passes", 1e-3},
                                                            {"simplex", 1e-3},
                                                            {"kalman, one pass", 0.05}};
  return *kBounds;
}

// Would catch an estimator with weights or a problem of its own, one that stops early, and P_0 that
// pulls to nominal: the chapter's filter ended at 5.8 mm.
TEST(Section11, EveryEstimatorEndsInTheSameMinimum) {
  for (const Section11Seed& seed : Result().seeds) {
    for (DimeSet set : {DimeSet::kComplete, DimeSet::kReduced, DimeSet::kSelected}) {
      const auto best = Fits(seed, set, "levenberg_marquardt");
      for (const Bound& bound : Bounds()) {
        const auto fits = Fits(seed, set, bound.estimator);
        for (size_t i = 0; i < fits.size(); ++i) {
          EXPECT_LE(fits[i]->cost, (1 + bound.cost_above) * best[i]->cost)
              << bound.estimator << ", " << Name(set) << ", "
              << Where(seed, fits[i]->calibration_poses);
        }
      }
    }
  }
}

// On the 14 alone the model error is 100 times the noise: the errors in mm agree to 1 % all the
// same.
TEST(Section11, OnFourteenTheEstimatorsAgreeInMillimetres) {
  for (const Section11Seed& seed : Result().seeds) {
    const auto best = Fits(seed, DimeSet::kReduced, "levenberg_marquardt");
    for (const char* estimator : {"simplex", "kalman, two passes"}) {
      const auto fits = Fits(seed, DimeSet::kReduced, estimator);
      for (size_t i = 0; i < fits.size(); ++i) {
        EXPECT_NEAR(fits[i]->control.mean, best[i]->control.mean, 0.01 * best[i]->control.mean)
            << estimator << ", " << Where(seed, fits[i]->calibration_poses);
        EXPECT_NEAR(fits[i]->calibration.mean, best[i]->calibration.mean,
                    0.01 * best[i]->calibration.mean)
            << estimator << ", " << Where(seed, fits[i]->calibration_poses);
      }
    }
  }
}

// Of nested sets the larger one's weighted cost is never larger, to where each estimator ends. The
// chapter's amoeba breaks this: 0.316 mm with 25 parameters, 0.294 with 14.
TEST(Section11, CostOfTheLargerSetIsNeverLarger) {
  for (const Section11Seed& seed : Result().seeds) {
    for (const Bound& bound : Bounds()) {
      const auto all = Fits(seed, DimeSet::kComplete, bound.estimator),
                 reduced = Fits(seed, DimeSet::kReduced, bound.estimator),
                 selected = Fits(seed, DimeSet::kSelected, bound.estimator);
      const double most = 1 + std::max(bound.cost_above, 1e-9);
      for (size_t i = 0; i < all.size(); ++i) {
        EXPECT_LE(all[i]->cost, most * selected[i]->cost) << bound.estimator << seed.seed;
        EXPECT_LE(selected[i]->cost, most * reduced[i]->cost) << bound.estimator << seed.seed;
      }
    }
  }
}

// The same by the other criteria. Would catch cross-validation that gives up at the first step that
// a few readings make uncertain (0.33 mm with 60 poses). With 40 poses of this robot it takes
// another way and does not find al4 and al5, which help only together: 0.23 mm, no bound.
TEST(Section11, OtherCriteriaReachNearlyTheSame) {
  for (SelectionCriterion criterion :
       {SelectionCriterion::kBic, SelectionCriterion::kCrossValidation}) {
    Section11Options options;
    options.seeds = {3};
    options.selection.criterion = criterion;
    const auto result = Section11(options, {});
    ASSERT_TRUE(result.ok()) << result.status();
    for (const DimeFit* fit : Fits(result->seeds[0], DimeSet::kSelected, "levenberg_marquardt")) {
      if (criterion == SelectionCriterion::kCrossValidation && fit->calibration_poses == 40)
        continue;
      EXPECT_LE(fit->control.mean, 0.11 * kMm) << Name(criterion) << fit->calibration_poses;
    }
  }
}

// Would catch seeds that do not reach the draws, and a state that one run leaves for the next.
TEST(Section11, IsTheSameForTheSameSeedAndAnotherForAnother) {
  Section11Options options;
  options.seeds = {2, 2};
  const auto result = Section11(options, {});
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->seeds[0].fits.back().control.mean, result->seeds[1].fits.back().control.mean);
  EXPECT_EQ(result->seeds[0].fits.back().control.mean, Result().seeds[1].fits.back().control.mean);
  EXPECT_NE(Result().seeds[0].nominal.max, Result().seeds[1].nominal.max);
}

TEST(Section11, SaysWhereItIsAndStopsWhenTold) {
  double last = 0;
  Hooks hooks;
  hooks.on_progress = [&](const Progress& progress) {
    EXPECT_GT(progress.fraction, last);
    last = progress.fraction;
  };
  hooks.is_cancelled = [&] { return last > 0; };
  Section11Options options;
  options.seeds = {1};
  EXPECT_EQ(Section11(options, hooks).status().code(), absl::StatusCode::kCancelled);
  options.seeds.clear();
  EXPECT_EQ(Section11(options, {}).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace truepose
