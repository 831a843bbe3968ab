#include "server/services/bindings/bindings.h"

#include "server/services/bindings/binding.h"

namespace truepose::services {

std::vector<std::unique_ptr<grpc::Service>> BindServices(const CallContext& call,
                                                         const Executors& executors,
                                                         rpc::Drain& drain,
                                                         const WatchSettings& watch) {
  std::vector<std::unique_ptr<grpc::Service>> services;
  services.push_back(BindRobotService(call, executors));
  services.push_back(BindPlantService(call, executors));
  services.push_back(BindSessionService(call, executors, drain));
  services.push_back(BindCalibrationService(call, executors, drain));
  services.push_back(BindCompensationTableService(call, executors));
  services.push_back(BindRecalibrationService(call, executors));
  services.push_back(BindDownloadService(call, executors, drain, watch));
  services.push_back(BindWatchService(call, executors, drain, watch));
  services.push_back(BindAdminService(call, executors));
  return services;
}

}  // namespace truepose::services
