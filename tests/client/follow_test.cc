#include <gtest/gtest.h>

#include <atomic>

#include "client/watch.h"
#include "tests/client/fake_server.h"
#include "truepose/v1/watch_services.grpc.pb.h"

namespace truepose::client {
namespace {

// Sends one revision a call and then ends it, as a server does with a reader that took nothing for
// long.
class CutsReaders final : public v1::WatchService::Service {
 public:
  grpc::Status Watch(grpc::ServerContext*, const v1::WatchRequest* request,
                     grpc::ServerWriter<v1::WatchResponse>* writer) override {
    asked_from.push_back(request->after_revision());
    v1::WatchResponse response;
    response.set_epoch("e");
    response.set_revision(10 * static_cast<int64_t>(asked_from.size()));
    writer->Write(response);
    return {grpc::StatusCode::CANCELLED, "took nothing for 40 s"};
  }

  std::vector<int64_t> asked_from;
};

// Would catch a follower that gives up when the server cuts it, or begins again from the start.
TEST(FollowWatch, GoesOnWhereItWasCut) {
  CutsReaders service;
  testing::FakeServer server(service);
  const Client client = server.MakeClient();
  int heard = 0, reconnects = 0;
  const absl::Status status =
      FollowWatch(client, {}, [&](const v1::WatchResponse&) { return ++heard < 3; },
                  {.on_reconnect = [&](const absl::Status&) { ++reconnects; }});
  EXPECT_TRUE(status.ok()) << status;
  EXPECT_EQ(reconnects, 2);
  EXPECT_EQ(service.asked_from, (std::vector<int64_t>{0, 10, 20}));
}

}  // namespace
}  // namespace truepose::client
