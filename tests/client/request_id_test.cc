// Changes carry an id of their own, so that a repeat has one effect.
#include <grpcpp/server_context.h>

#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "tests/client/fake_server.h"
#include "truepose/v1/plant_services.grpc.pb.h"
#include "truepose/v1/services.grpc.pb.h"

namespace truepose::client {
namespace {

// Remembers ids; the first answer of each call is lost.
class Releases final : public v1::CalibrationService::Service {
 public:
  grpc::Status ApproveCalibration(grpc::ServerContext*,
                                  const v1::ApproveCalibrationRequest* request,
                                  v1::Calibration*) override {
    ids.push_back(request->request_id());
    return ids.size() == 1 ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "lost") : grpc::Status::OK;
  }
  std::vector<std::string> ids;
};

class Plant final : public v1::PlantService::Service {
 public:
  grpc::Status DeleteInstrument(grpc::ServerContext*, const v1::DeleteInstrumentRequest* request,
                                v1::Instrument* instrument) override {
    ids.push_back(request->request_id());
    instrument->set_name(request->name());
    return ids.size() == 1 ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "lost") : grpc::Status::OK;
  }
  std::vector<std::string> ids;
};

// Would catch a change that is repeated without an id, or with another one each time.
TEST(RequestIdTest, TheRepeatsOfACallShareOne) {
  Releases service;
  const testing::FakeServer server(service);
  ASSERT_TRUE(server.Connect().ApproveCalibration({}).ok());
  ASSERT_EQ(service.ids.size(), 2u);
  EXPECT_EQ(service.ids[0].size(), 36u);
  EXPECT_EQ(service.ids[0], service.ids[1]);
  ASSERT_TRUE(server.Connect().ApproveCalibration({}).ok());
  EXPECT_NE(service.ids[2], service.ids[0]) << "another call is another change";
}

// Would catch an id of the caller's that is thrown away: it repeats calls as a whole.
TEST(RequestIdTest, TheCallersStays) {
  Releases service;
  const testing::FakeServer server(service);
  v1::ApproveCalibrationRequest request;
  request.set_request_id("00000000-0000-4000-8000-000000000001");
  ASSERT_TRUE(server.Connect().ApproveCalibration(request).ok());
  EXPECT_EQ(service.ids, std::vector<std::string>(2, request.request_id()));
}

// The same for calls by name: would catch one that reaches another method, or brings back
// nothing.
TEST(RequestIdTest, CallsByNameHaveOneToo) {
  Plant service;
  const testing::FakeServer server(service);
  v1::DeleteInstrumentRequest request;
  request.set_name("instruments/lt-1");
  const std::string method = "truepose.v1.PlantService/DeleteInstrument";
  v1::Instrument instrument;
  ASSERT_TRUE(server.Connect().CallMethod(method, request, &instrument).ok());
  EXPECT_EQ(instrument.name(), "instruments/lt-1");
  ASSERT_EQ(service.ids.size(), 2u);
  EXPECT_EQ(service.ids[0].size(), 36u);
  EXPECT_EQ(service.ids[0], service.ids[1]);
}

}  // namespace
}  // namespace truepose::client
