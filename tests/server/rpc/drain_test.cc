#include "server/rpc/drain.h"

#include <vector>

#include "gtest/gtest.h"

namespace truepose::rpc {
namespace {

class FakeStream : public Endable {
 public:
  void End(const absl::Status& status) override { ends.push_back(status); }
  std::vector<absl::Status> ends;
};

// Would catch a watch that keeps the server from stopping, or a client that takes the end for the
// last word.
TEST(DrainTest, EndsOpenStreamsWithUnavailable) {
  Drain drain;
  const auto stream = std::make_shared<FakeStream>();
  drain.Add(stream);
  EXPECT_TRUE(stream->ends.empty());
  drain.Begin();
  ASSERT_EQ(stream->ends.size(), 1u);
  EXPECT_TRUE(absl::IsUnavailable(stream->ends[0]));
  drain.Begin();
  EXPECT_EQ(stream->ends.size(), 1u);
}

// Would catch a stream that slips in behind the drain.
TEST(DrainTest, EndsLateStreamsAtOnce) {
  Drain drain;
  drain.Begin();
  const auto stream = std::make_shared<FakeStream>();
  drain.Add(stream);
  EXPECT_EQ(stream->ends.size(), 1u);
}

// Would catch a drain that keeps streams alive or touches dead ones.
TEST(DrainTest, ForgetsStreamsThatEnded) {
  Drain drain;
  auto stream = std::make_shared<FakeStream>();
  const std::weak_ptr<FakeStream> watched = stream;
  drain.Add(stream);
  stream.reset();
  EXPECT_TRUE(watched.expired());
  drain.Begin();
}

}  // namespace
}  // namespace truepose::rpc
