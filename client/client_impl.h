// What a Client holds; for the .cc files of the library only, so that its users never include gRPC.
#pragma once

#include <memory>
#include <string>

#include "client/client.h"
#include "grpcpp/channel.h"
#include "grpcpp/client_context.h"
#include "truepose/v1/admin_services.grpc.pb.h"
#include "truepose/v1/compensation_table_services.grpc.pb.h"
#include "truepose/v1/download_services.grpc.pb.h"
#include "truepose/v1/recalibration_services.grpc.pb.h"
#include "truepose/v1/services.grpc.pb.h"
#include "truepose/v1/watch_services.grpc.pb.h"

namespace truepose::client {

struct Client::Impl {
  Impl(std::shared_ptr<grpc::Channel> channel, std::string address, ClientOptions options);

  std::string address;
  ClientOptions options;
  std::shared_ptr<grpc::Channel> channel;
  std::unique_ptr<v1::RobotService::Stub> robots;
  std::unique_ptr<v1::SessionService::Stub> sessions;
  std::unique_ptr<v1::CalibrationService::Stub> calibrations;
  std::unique_ptr<v1::CompensationTableService::Stub> tables;
  std::unique_ptr<v1::AdminService::Stub> admin;
  std::unique_ptr<v1::RecalibrationService::Stub> recalibrations;
  std::unique_ptr<v1::DownloadService::Stub> downloads;
  std::unique_ptr<v1::WatchService::Stub> watches;
};

// The metadata that every call carries, the token's secret among them.
void PrepareContext(grpc::ClientContext& context, const ClientOptions& options);

}  // namespace truepose::client
