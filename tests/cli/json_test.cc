#include "client/cli/json.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/fault.h"
#include "google/protobuf/struct.pb.h"
#include "google/protobuf/util/json_util.h"
#include "google/protobuf/util/message_differencer.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::cli {
namespace {

// Would catch camelCase names, left-out zeros and a line break inside of the object.
TEST(ToJson, KeepsProtoNamesAndPrintsZeros) {
  v1::Statistics statistics;
  statistics.set_rms(0.5);
  EXPECT_EQ(ToJson(statistics).value(), R"({"mean":0,"sd":0,"rms":0.5,"max":0})");
  v1::SetReport set;
  set.mutable_before()->mutable_position_mm();
  EXPECT_EQ(
      ToJson(set).value(),
      R"({"poses":0,"before":{"position_mm":{"mean":0,"sd":0,"rms":0,"max":0}},"digest":""})");
}

// Would catch digits lost on the way through a --output file: compensation would have other bits
// than the server's.
TEST(Json, KeepsEveryBitOfADouble) {
  v1::Calibration calibration;
  for (const double value : {0.1, 1.0 / 3.0, -1e-300, std::numeric_limits<double>::denorm_min(),
                             12345.678901234567, 0x1.fffffffffffffp-3}) {
    v1::InternalParameter& parameter = *calibration.add_internal_parameters();
    parameter.set_name("dq");
    parameter.set_value(value);
  }
  v1::Calibration read;
  ASSERT_TRUE(FromJson(ToJson(calibration, true).value(), "f", &read).ok());
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(calibration, read));
}

// Would catch a file of another kind taken for a calibration.
TEST(FromJson, NamesFileAndExpectedMessage) {
  for (const char* text :
       {"", "{", "[]", "{\"nonsense\":1}", "{\"internal_parameters\":3}", "\xff"}) {
    v1::Calibration calibration;
    const absl::Status status = FromJson(text, "a.json", &calibration);
    ASSERT_EQ(FaultsOf(status).size(), 1u) << text;
    EXPECT_EQ(FaultsOf(status)[0].field, "a.json");
    EXPECT_EQ(FaultsOf(status)[0].expected, "the JSON of a Calibration");
  }
}

// Would catch a quote, a control character or a byte of another encoding that ends the JSON early.
TEST(JsonString, EscapesEverything) {
  EXPECT_EQ(JsonString("a\"b\\c\n\t\x01"), R"("a\"b\\c\n\t\u0001")");
  EXPECT_EQ(JsonString("µm"), "\"µm\"");
  EXPECT_EQ(JsonString("a\xff\xc3"), R"("a\ufffd\ufffd")");
  EXPECT_EQ(JsonString(""), "\"\"");
}

// Would catch an error object of another shape than documented: a strict reader reads it back.
TEST(ErrorJson, HasCodeMessageAndFaults) {
  FaultList faults;
  faults.Add("a.csv:3: q1_rad", "'x'", "a number");
  faults.Add("--split", "'odd'", "even-odd");
  google::protobuf::Struct object;
  ASSERT_TRUE(
      google::protobuf::util::JsonStringToMessage(ErrorJson(faults.ToStatus()), &object).ok());
  const auto& error = object.fields().at("error").struct_value().fields();
  EXPECT_EQ(error.at("code").string_value(), "INVALID_ARGUMENT");
  EXPECT_NE(error.at("message").string_value().find("a.csv:3"), std::string::npos);
  ASSERT_EQ(error.at("faults").list_value().values_size(), 2);
  const auto& fault = error.at("faults").list_value().values(1).struct_value().fields();
  EXPECT_EQ(fault.at("field").string_value(), "--split");
  EXPECT_EQ(fault.at("found").string_value(), "'odd'");
  EXPECT_EQ(fault.at("expected").string_value(), "even-odd");
}

}  // namespace
}  // namespace truepose::cli
