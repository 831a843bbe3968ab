// The answers of `truepose reproduce` as JSON objects.
#include "client/cli/json_value.h"
#include "client/cli/reproduce.h"
#include "core/reproduce/printed.h"

namespace truepose::cli {
namespace {

using google::protobuf::Struct;
using google::protobuf::Value;

constexpr double kMillimetres = 1e3;

Value Names(const std::vector<std::string>& names) { return List(names, Text); }

Value Errors(const Statistics& m) {
  return Object(StructOf({{"mean_mm", Number(kMillimetres * m.mean)},
                          {"sd_mm", Number(kMillimetres * m.sd)},
                          {"max_mm", Number(kMillimetres * m.max)}}));
}

Value Errors(const PrintedErrors& mm) {
  return Object(StructOf({{"mean_mm", Number(mm.mean_mm)},
                          {"sd_mm", Number(mm.sd_mm)},
                          {"max_mm", Number(mm.max_mm)}}));
}

Value Fit(const DimeFit& fit) {
  return Object(StructOf({{"parameters", Text(Name(fit.set))},
                          {"estimator", Text(fit.estimator)},
                          {"calibration_poses", Number(fit.calibration_poses)},
                          {"control_poses", Number(fit.control_poses)},
                          {"calibration", Errors(fit.calibration)},
                          {"control", Errors(fit.control)},
                          {"complete", Errors(fit.complete)},
                          {"cost", Number(fit.cost)},
                          {"time_s", Number(fit.time_s)},
                          {"termination", Text(Name(fit.termination))},
                          {"added", Names(fit.added)}}));
}

Value Split(const DimeSplit& split) {
  return Object(StructOf({{"calibration_poses", Number(split.calibration_poses)},
                          {"control_poses", Number(split.control_poses)},
                          {"nominal_calibration", Errors(split.nominal_calibration)},
                          {"nominal_control", Errors(split.nominal_control)},
                          {"base_and_tool_fitted_calibration", Errors(split.frames_calibration)},
                          {"base_and_tool_fitted_control", Errors(split.frames_control)},
                          {"true_parameters_calibration", Errors(split.true_calibration)},
                          {"true_parameters_control", Errors(split.true_control)}}));
}

Value Step(const SelectionStep& step) {
  Value taken;
  taken.set_bool_value(step.taken);
  return Object(StructOf({{"added", Text(step.added)},
                          {"parameters", Number(step.parameters)},
                          {"weighted_rms", Number(step.weighted_rms)},
                          {"criterion", Number(step.criterion)},
                          {"taken", taken}}));
}

Value Selection(const SelectionRun& run) {
  return Object(StructOf({{"calibration_poses", Number(run.calibration_poses)},
                          {"time_s", Number(run.time_s)},
                          {"path", List(run.result.path, Step)}}));
}

Value Seed(const Section11Seed& seed) {
  return Object(
      StructOf({{"seed", Number(static_cast<double>(seed.seed))},
                {"nominal", Errors(seed.nominal)},
                {"operators", Errors(seed.operators.difference_m)},
                {"mean_plus_3_sd_mm", Number(kMillimetres * seed.operators.mean_plus_3_sd_m)},
                {"iso_rp_mm", Number(kMillimetres * seed.operators_iso.pooled_m)},
                {"splits", List(seed.splits, Split)},
                {"selections", List(seed.selections, Selection)},
                {"fits", List(seed.fits, Fit)}}));
}

Value Printed(const PrintedRow& row) {
  Struct object = StructOf({{"table", Number(row.table)},
                            {"algorithm", Text(row.algorithm)},
                            {"time", Text(row.time)},
                            {"calibration_poses", Number(row.calibration_poses)},
                            {"calibration", Errors(row.calibration)},
                            {"complete", Errors(row.complete)}});
  if (row.control) (*object.mutable_fields())["control"] = Errors(*row.control);
  return Object(std::move(object));
}

Value PrintedChoice(const PrintedSelection& selection) {
  return Object(StructOf({{"algorithm", Text(selection.algorithm)},
                          {"calibration_poses", Number(selection.calibration_poses)},
                          {"added", Names(selection.added)}}));
}

Value Column(const Table3Column& column) {
  return Object(StructOf({{"model", Text(column.model)},
                          {"names", Names(column.names)},
                          {"base", Names(column.base)},
                          {"gripper", Names(column.gripper)},
                          {"internal", Number(column.internal)},
                          {"redundant", Names(column.redundant)},
                          {"printed_names", Names(column.printed_names)},
                          {"printed_base", Names(column.printed_base)},
                          {"printed_gripper", Names(column.printed_gripper)}}));
}

}  // namespace

google::protobuf::Struct Table2Json(const Table2Result& table) {
  std::vector<Value> columns;
  for (Eigen::Index j = 0; j < table.J.cols(); ++j) {
    const Eigen::VectorXd column = table.J.col(j);
    columns.push_back(Object(StructOf({{"parameter", Text(table.names[j])},
                                       {"column", List(column, Number)},
                                       {"chapter", Text(table.printed[j])}})));
  }
  return StructOf({{"columns", List(columns, [](const Value& value) { return value; })},
                   {"null_relation", List(table.null_relation, Number)}});
}

google::protobuf::Struct Table3Json(const std::vector<Table3Column>& columns) {
  return StructOf({{"models", List(columns, Column)}});
}

google::protobuf::Struct Section11Json(const Section11Result& result) {
  return StructOf({{"seeds", List(result.seeds, Seed)},
                   {"chapter", List(PrintedRows(), Printed)},
                   {"chapter_selections", List(PrintedSelections(), PrintedChoice)}});
}

}  // namespace truepose::cli
