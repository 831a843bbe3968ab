#include "server/services/admin.h"
#include "server/services/bindings/binding.h"
#include "truepose/v1/admin_services.grpc.pb.h"

namespace truepose::services {
namespace {

class AdminBinding final : public v1::AdminService::CallbackService {
 public:
  AdminBinding(const CallContext& call, const Executors& executors)
      : call_(call), handlers_(executors.handlers) {}

  TRUEPOSE_BIND(Bootstrap, BootstrapRequest, CreateTokenResponse, handlers_)
  TRUEPOSE_BIND(CreateToken, CreateTokenRequest, CreateTokenResponse, handlers_)
  TRUEPOSE_BIND(ListTokens, ListTokensRequest, ListTokensResponse, handlers_)
  TRUEPOSE_BIND(RevokeToken, RevokeTokenRequest, Token, handlers_)
  TRUEPOSE_BIND(GetServerStatus, GetServerStatusRequest, ServerStatus, handlers_)

 private:
  const CallContext call_;
  rpc::Executor& handlers_;
};

}  // namespace

std::unique_ptr<grpc::Service> BindAdminService(const CallContext& call,
                                                const Executors& executors) {
  return std::make_unique<AdminBinding>(call, executors);
}

}  // namespace truepose::services
