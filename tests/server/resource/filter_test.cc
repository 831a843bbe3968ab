#include "server/resource/filter.h"

#include "tests/server/testing/expect_status.h"
#include "tests/server/testing/text_proto.h"
#include "truepose/v1/plant.pb.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/session.pb.h"

namespace truepose::resource {
namespace {

using testing::IsOk;
using testing::Parse;

v1::Session Session() {
  return Parse<v1::Session>(R"pb(
    state: SEALED
    display_name: "hall 3, cell 7"
    reading_count: 40
    temperature_c: 21.5
    create_time { seconds: 1790000000 }
  )pb");
}

bool Matches(const std::string& filter) {
  const auto predicate = ParseFilter(filter, v1::Session::descriptor());
  EXPECT_THAT(predicate, IsOk()) << filter;
  return predicate.ok() && (*predicate)(Session());
}

// Would catch an operator, a type of field or AND that is read wrongly.
TEST(Filter, TermsHoldAsWritten) {
  for (const char* filter :
       {"", "state = \"SEALED\"", "state != \"OPEN\"", "reading_count >= 40", "reading_count < 41",
        "temperature_c > 21", "display_name = \"hall 3*\"", "display_name = \"*3*7\"",
        "display_name != \"*8*\"", "state=\"SEALED\" AND reading_count=40",
        "create_time < \"2030-01-01T00:00:00Z\""}) {
    EXPECT_TRUE(Matches(filter)) << filter;
  }
  for (const char* filter :
       {"state = \"OPEN\"", "reading_count > 40", "display_name = \"hall\"",
        "display_name = \"*hall 4*\"", "state = \"SEALED\" AND reading_count = 41",
        "delete_time > \"2020-01-01T00:00:00Z\"", "create_time > \"2030-01-01T00:00:00Z\""}) {
    EXPECT_FALSE(Matches(filter)) << filter;
  }
}

// Would catch a look-up that misses what the filter would accept, or takes another field's text.
TEST(Filter, TextAskedForIsThatOfOneTerm) {
  EXPECT_EQ(TextAskedFor(R"(sha256 = "9f86")", "sha256"), "9f86");
  EXPECT_EQ(TextAskedFor(R"(state = "READY" AND sha256 = "9f86")", "sha256"), "9f86");
  for (const char* other :
       {R"(sha256 = "9f*")", R"(sha256 != "9f86")", R"(state = "sha256")", R"(uid = "9f86")", "",
        R"(sha256 = )", R"(sha256 = "9f86)", "sha256 = 5"}) {
    EXPECT_EQ(TextAskedFor(other, "sha256"), std::nullopt) << other;
  }
}

// Would catch a filter that is silently ignored, and a message that doesn't say where it is wrong.
TEST(Filter, FaultsSayWhereAndWhat) {
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"nonsense = 3", "'nonsense' at column 1"},
      {"state SEALED", "no operator at column 6"},
      {"state = \"CLOSED\"", "'CLOSED' at column 9"},
      {"reading_count = many", "'many' at column 17"},
      {"display_name = \"open", "a text without an end at column 16"},
      {"state = \"OPEN\" OR state = \"SEALED\"", "'OR' at column 16"},
      {"state = \"OPEN\" AND", "'AND' at column 16"},
      {"state < \"OPEN\"", "'OPEN' at column 9"},
      {"extra_columns = \"a\"", "'extra_columns' at column 1"},
      {"state = ;", "';' at column 9"},
      {"state =", "no value at column 8"},
  };
  for (const auto& [filter, found] : faults) {
    const auto predicate = ParseFilter(filter, v1::Session::descriptor());
    ASSERT_FALSE(predicate.ok()) << filter;
    const std::vector<Fault> told = FaultsOf(predicate.status());
    ASSERT_EQ(told.size(), 1u) << filter;
    EXPECT_EQ(told[0].field, "filter");
    EXPECT_EQ(told[0].found, found) << filter;
  }
}

// Would catch paths into messages that are not followed.
TEST(Filter, PathsReachIntoMessages) {
  const auto robot = Parse<v1::Robot>(R"pb(limits { drift_rms_mm: 0.5 })pb");
  const auto predicate = ParseFilter("limits.drift_rms_mm = 0.5", v1::Robot::descriptor());
  ASSERT_THAT(predicate, IsOk());
  EXPECT_TRUE((*predicate)(robot));
  EXPECT_FALSE((*predicate)(v1::Robot()));
}

}  // namespace
}  // namespace truepose::resource
