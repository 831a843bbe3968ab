#include "server/services/bindings/binding.h"
#include "server/services/standard.h"
#include "truepose/v1/plant_services.grpc.pb.h"

namespace truepose::services {
namespace {

class PlantBinding final : public v1::PlantService::CallbackService {
 public:
  PlantBinding(const CallContext& call, const Executors& executors)
      : call_(call), handlers_(executors.handlers) {}

  TRUEPOSE_BIND_RESOURCE(Instrument, Instruments)
  TRUEPOSE_BIND_RESOURCE(RegisteredTool, RegisteredTools)
  TRUEPOSE_BIND_RESOURCE(RegisteredFixture, RegisteredFixtures)
  TRUEPOSE_BIND_RESOURCE(Target, Targets)
  TRUEPOSE_BIND_RESOURCE(Placement, Placements)
  TRUEPOSE_BIND_RESOURCE(PoseSet, PoseSets)

 private:
  const CallContext call_;
  rpc::Executor& handlers_;
};

}  // namespace

std::unique_ptr<grpc::Service> BindPlantService(const CallContext& call,
                                                const Executors& executors) {
  return std::make_unique<PlantBinding>(call, executors);
}

}  // namespace truepose::services
