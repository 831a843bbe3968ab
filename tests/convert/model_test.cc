#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "convert/run.h"
#include "core/base/fault.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

using ::testing::ElementsAre;
using ::testing::Field;

// Would catch kept marks on other parameters than those of the basis, and formulas in each other's
// fields.
TEST(ModelDescription, CountsAndMarksAgree) {
  const auto model = RunModelDescription(MeasuringRobot(), "incremental");
  ASSERT_TRUE(model.ok()) << model.status();
  EXPECT_EQ(model->counts().complete(), 26);
  EXPECT_EQ(model->counts().measured(), 26);
  EXPECT_EQ(model->counts().internal(), 14);
  EXPECT_EQ(model->counts().generic_rank(), 26);
  EXPECT_EQ(model->counts().rank(), 0) << "there are no readings";
  int kept = 0;
  for (const v1::ModelParameter& parameter : model->parameters()) {
    kept += parameter.kept();
    for (const v1::Redundancy& redundancy : model->redundancies())
      EXPECT_FALSE(parameter.kept() && redundancy.dropped() == parameter.name());
  }
  EXPECT_EQ(kept, 26);
  EXPECT_EQ(kept + model->redundancies_size(), model->parameters_size());
  EXPECT_EQ(model->parameters(0).group(), v1::BASE);
  EXPECT_EQ(model->parameters(0).unit(), "mm");
  EXPECT_EQ(model->parameters(11).group(), v1::TOOL);
  EXPECT_EQ(model->parameters(11).unit(), "deg");
  EXPECT_EQ(model->parameters(12).group(), v1::INTERNAL);
}

// As in CalibrationOptions "" is the modified incremental one.
TEST(ModelDescription, DefaultAndFaults) {
  const auto model = RunModelDescription(SampleNominal(), "");
  ASSERT_TRUE(model.ok()) << model.status();
  EXPECT_EQ(model->model(), "modified_incremental");
  EXPECT_THAT(FaultsOf(RunModelDescription(SampleNominal(), "dh").status()),
              ElementsAre(Field(&Fault::field, "options.model")));
  EXPECT_FALSE(RunModelDescription(v1::Nominal(), "").ok());
}

}  // namespace
}  // namespace truepose::convert
