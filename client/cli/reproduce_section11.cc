// Sec. 11 as text: means over the seeds, the chapter's figures in the last columns.
#include <algorithm>
#include <functional>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "client/cli/reproduce.h"
#include "client/cli/table.h"
#include "core/reproduce/measuring_robot.h"
#include "core/reproduce/printed.h"

namespace truepose::cli {
namespace {

constexpr double kMm = 1e-3;
constexpr DimeSet kSets[] = {DimeSet::kComplete, DimeSet::kReduced, DimeSet::kSelected};

std::string Mm(double metres) { return Fixed(metres / kMm, 3); }

double MeanOver(const Section11Result& result,
                const std::function<double(const Section11Seed&)>& figure) {
  double sum = 0;
  for (const Section11Seed& seed : result.seeds) sum += figure(seed);
  return sum / static_cast<double>(result.seeds.size());
}

const PrintedRow* Printed(int table, const std::string& algorithm, int poses) {
  for (const PrintedRow& row : PrintedRows()) {
    if (row.table == table && row.algorithm == algorithm && row.calibration_poses == poses)
      return &row;
  }
  return nullptr;
}

std::string ChapterName(const std::string& estimator) {
  if (estimator == "simplex") return "amoeba";
  if (estimator == "linear_iteration") return "linear";
  return estimator == "kalman, one pass" ? "kalman" : "";
}

// Mean figures of the printed row: calibration, control, complete, time.
std::vector<std::string> Cells(const PrintedRow* row) {
  if (row == nullptr) return {"", "", "", ""};
  return {Fixed(row->calibration.mean_mm, 3), row->control ? Fixed(row->control->mean_mm, 3) : "-",
          Fixed(row->complete.mean_mm, 3), row->time};
}

// The maximum is that of all seeds.
std::string Most(const Section11Result& result, size_t fit) {
  double most = 0;
  for (const Section11Seed& seed : result.seeds) most = std::max(most, seed.fits[fit].control.max);
  return Mm(most);
}

std::vector<std::string> FitCells(const Section11Result& result, size_t index, int table) {
  const DimeFit& fit = result.seeds.front().fits[index];
  const auto mean = [&](const std::function<double(const DimeFit&)>& figure) {
    return MeanOver(result, [&](const Section11Seed& seed) { return figure(seed.fits[index]); });
  };
  std::vector<std::string> cells = {
      fit.estimator,
      absl::StrCat(fit.calibration_poses),
      Mm(mean([](const DimeFit& f) { return f.calibration.mean; })),
      Mm(mean([](const DimeFit& f) { return f.control.mean; })),
      Mm(mean([](const DimeFit& f) { return f.control.sd; })),
      Most(result, index),
      Mm(mean([](const DimeFit& f) { return f.complete.mean; })),
      absl::StrFormat("%.1f ms", 1e3 * mean([](const DimeFit& f) { return f.time_s; }))};
  const std::string name = ChapterName(fit.estimator);
  for (std::string& cell :
       Cells(name.empty() ? nullptr : Printed(table, name, fit.calibration_poses)))
    cells.push_back(std::move(cell));
  return cells;
}

std::string SetText(const Section11Result& result, DimeSet set, int table) {
  Table text({{"estimator", Align::kLeft},
              {"poses"},
              {"calibration"},
              {"control"},
              {"its sd"},
              {"its max"},
              {"complete"},
              {"time"},
              {"chapter cal."},
              {"control"},
              {"complete"},
              {"time"}});
  for (const DimeEstimator& estimator : DimeEstimators()) {
    const std::vector<DimeFit>& fits = result.seeds.front().fits;
    for (size_t i = 0; i < fits.size(); ++i) {
      if (fits[i].set == set && fits[i].estimator == estimator.name)
        text.Add(FitCells(result, i, table));
    }
  }
  return absl::StrCat("\n", Name(set), " parameters (chapter: Table ", table, ")\n", text.Text());
}

std::string BeforeText(const Section11Result& result) {
  Table text({{"poses"},
              {"nominal cal."},
              {"control"},
              {"base, tool fitted cal."},
              {"control"},
              {"true parameters cal."},
              {"control"},
              {"chapter cal."},
              {"control"}});
  for (size_t i = 0; i < result.seeds.front().splits.size(); ++i) {
    const int poses = result.seeds.front().splits[i].calibration_poses;
    std::vector<std::string> cells = {absl::StrCat(poses)};
    for (const Statistics DimeSplit::*set :
         {&DimeSplit::nominal_calibration, &DimeSplit::nominal_control,
          &DimeSplit::frames_calibration, &DimeSplit::frames_control, &DimeSplit::true_calibration,
          &DimeSplit::true_control}) {
      cells.push_back(Mm(
          MeanOver(result, [&](const Section11Seed& seed) { return (seed.splits[i].*set).mean; })));
    }
    const std::vector<std::string> printed = Cells(Printed(4, "", poses));
    cells.insert(cells.end(), printed.begin(), printed.begin() + 2);
    text.Add(std::move(cells));
  }
  return absl::StrCat("\nBefore (chapter: Table 4, nominal parameters), and what noise leaves\n",
                      text.Text());
}

std::string RepeatabilityText(const Section11Result& result) {
  const PrintedRepeatability printed;
  Table text({{"two operators", Align::kLeft},
              {"mean"},
              {"sd"},
              {"max"},
              {"mean + 3 sd"},
              {"ISO 9283 RP, pooled"}});
  const auto mean = [&](const std::function<double(const Section11Seed&)>& figure) {
    return Mm(MeanOver(result, figure));
  };
  text.Add({"ours", mean([](const auto& s) { return s.operators.difference_m.mean; }),
            mean([](const auto& s) { return s.operators.difference_m.sd; }),
            mean([](const auto& s) { return s.operators.difference_m.max; }),
            mean([](const auto& s) { return s.operators.mean_plus_3_sd_m; }),
            mean([](const auto& s) { return s.operators_iso.pooled_m; })});
  text.Add({"chapter", Fixed(printed.mean_mm, 3), Fixed(printed.sd_mm, 3), Fixed(printed.max_mm, 3),
            Fixed(printed.mean_plus_3_sd_mm, 3), "-"});
  return absl::StrCat("\nRepeatability\n", text.Text());
}

std::string TimesSelected(const Section11Result& result, const std::string& name, size_t split) {
  int times = 0;
  for (const Section11Seed& seed : result.seeds) {
    const std::vector<std::string>& added = seed.selections[split].result.added;
    times += std::find(added.begin(), added.end(), name) != added.end() ? 1 : 0;
  }
  return absl::StrCat(times);
}

std::string SelectionText(const Section11Result& result) {
  Table text({{"parameter", Align::kLeft}, {"40"}, {"60"}, {"81"}, {"chapter", Align::kLeft}});
  for (const std::string& name : AdditionalSet()) {
    std::vector<std::string> cells = {name};
    for (size_t split = 0; split < 3; ++split) cells.push_back(TimesSelected(result, name, split));
    std::string chapter;
    for (const PrintedSelection& selection : PrintedSelections()) {
      if (std::find(selection.added.begin(), selection.added.end(), name) != selection.added.end())
        absl::StrAppend(&chapter, chapter.empty() ? "" : ", ", selection.algorithm, " ",
                        selection.calibration_poses);
    }
    cells.push_back(chapter);
    text.Add(std::move(cells));
  }
  return absl::StrCat("\nSelected, of ", Count(static_cast<long long>(result.seeds.size()), "seed"),
                      " (chapter: Table 8); once for all estimators, by levenberg_marquardt\n",
                      text.Text());
}

}  // namespace

std::string Section11Text(const Section11Result& result) {
  std::string text = absl::StrCat(
      "Calibration of a measuring robot (Sec. 11), ",
      Count(static_cast<long long>(result.seeds.size()), "simulated robot"),
      ". Position errors in mm, means over the robots.\nThe chapter's readings are not published: "
      "the experiment is repeated, its figures need not be.\nThe control of 81 poses is a second "
      "operator's readings.\n",
      RepeatabilityText(result), BeforeText(result));
  int table = 5;
  for (DimeSet set : kSets) absl::StrAppend(&text, SetText(result, set, table++));
  return absl::StrCat(text, SelectionText(result));
}

}  // namespace truepose::cli
