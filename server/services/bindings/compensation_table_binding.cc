#include "server/services/bindings/binding.h"
#include "server/services/compensation_tables.h"
#include "server/services/standard.h"
#include "truepose/v1/compensation_table_services.grpc.pb.h"

namespace truepose::services {
namespace {

class CompensationTableBinding final : public v1::CompensationTableService::CallbackService {
 public:
  CompensationTableBinding(const CallContext& call, const Executors& executors)
      : call_(call), handlers_(executors.handlers), compute_(executors.compute) {}

  // An estimate computes; what is only stored must not wait behind it.
  TRUEPOSE_BIND(CreateCompensationTable, CreateCompensationTableRequest, CompensationTable,
                (request->validate_only() ? compute_ : handlers_))
  TRUEPOSE_BIND_STANDARD(GetCompensationTable, CompensationTable, GetStandard)
  TRUEPOSE_BIND(GetActiveCompensationTable, GetActiveCompensationTableRequest, CompensationTable,
                handlers_)
  TRUEPOSE_BIND_STANDARD(ListCompensationTables, ListCompensationTablesResponse, ListStandard)
  TRUEPOSE_BIND(DeleteCompensationTable, DeleteCompensationTableRequest, CompensationTable,
                handlers_)
  TRUEPOSE_BIND(UndeleteCompensationTable, UndeleteCompensationTableRequest, CompensationTable,
                handlers_)

 private:
  const CallContext call_;
  rpc::Executor& handlers_;
  rpc::Executor& compute_;
};

}  // namespace

std::unique_ptr<grpc::Service> BindCompensationTableService(const CallContext& call,
                                                            const Executors& executors) {
  return std::make_unique<CompensationTableBinding>(call, executors);
}

}  // namespace truepose::services
