#include "server/services/bindings/binding.h"
#include "server/services/robots.h"
#include "truepose/v1/services.grpc.pb.h"

namespace truepose::services {
namespace {

class RobotBinding final : public v1::RobotService::CallbackService {
 public:
  RobotBinding(const CallContext& call, const Executors& executors)
      : call_(call), handlers_(executors.handlers) {}

  TRUEPOSE_BIND(CreateRobot, CreateRobotRequest, Robot, handlers_)
  TRUEPOSE_BIND(UpdateRobot, UpdateRobotRequest, Robot, handlers_)
  TRUEPOSE_BIND(DeleteRobot, DeleteRobotRequest, Robot, handlers_)
  TRUEPOSE_BIND(UndeleteRobot, UndeleteRobotRequest, Robot, handlers_)
  TRUEPOSE_BIND(GetRobot, GetRobotRequest, Robot, handlers_)
  TRUEPOSE_BIND(ListRobots, ListRobotsRequest, ListRobotsResponse, handlers_)
  TRUEPOSE_BIND(CreateNominalRevision, CreateNominalRevisionRequest, NominalRevision, handlers_)
  TRUEPOSE_BIND(GetNominalRevision, GetNominalRevisionRequest, NominalRevision, handlers_)
  TRUEPOSE_BIND(ListNominalRevisions, ListNominalRevisionsRequest, ListNominalRevisionsResponse,
                handlers_)

 private:
  const CallContext call_;
  rpc::Executor& handlers_;
};

}  // namespace

std::unique_ptr<grpc::Service> BindRobotService(const CallContext& call,
                                                const Executors& executors) {
  return std::make_unique<RobotBinding>(call, executors);
}

}  // namespace truepose::services
