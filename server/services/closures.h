// The two shapes of closure that handlers share.
#pragma once

#include <utility>

#include "absl/status/statusor.h"
#include "google/protobuf/repeated_field.h"
#include "server/resource/filter.h"
#include "server/resource/once.h"
#include "server/services/call_context.h"
#include "server/store/list.h"
#include "server/store/page.h"
#include "server/store/store.h"

namespace truepose::services {

// Writes, or with `validate_only` runs the same closure and rolls it back, so that both give the
// same answer.
template <typename Closure>
auto WriteUnless(bool validate_only, store::Store& store, Closure closure)
    -> std::invoke_result_t<Closure&, store::Transaction&> {
  using Result = std::invoke_result_t<Closure&, store::Transaction&>;
  if (!validate_only) return store.Write(std::move(closure));
  Result result = absl::UnavailableError("the store is closing");
  const absl::Status status = store.Write([&](store::Transaction& transaction) -> absl::Status {
    result = closure(transaction);
    if (!result.ok()) return result.status();
    return absl::CancelledError("validate_only");  // rolls back
  });
  if (!absl::IsCancelled(status)) return status;
  return result;
}

// The same for a request with an id: one effect and one answer for each (server/resource/once.h).
template <typename Request, typename Closure>
auto WriteOnce(const CallContext& call, const Request& request, Closure closure)
    -> std::invoke_result_t<Closure&, store::Transaction&> {
  using Result = std::invoke_result_t<Closure&, store::Transaction&>;
  const store::RequestKey key =
      resource::KeyOf(call.caller.principal, request, request.request_id());
  bool validate_only = false;
  if constexpr (requires { request.validate_only(); }) validate_only = request.validate_only();
  return WriteUnless(validate_only, call.store, [&](store::Transaction& transaction) {
    return resource::Once<typename Result::value_type>(transaction, key,
                                                       [&](auto& inner) { return closure(inner); });
  });
}

// The page_size and page_token of any List request.
template <typename Request>
store::PageRequest PageOf(const Request& request) {
  return {request.page_size(), request.page_token()};
}

// The filter and show_deleted of a List request. @returns kInvalidArgument with a fault of
// `filter`.
template <typename T, typename Request>
absl::StatusOr<store::ListFilter<T>> FilterOf(const Request& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(resource::Predicate belongs,
                            resource::ParseFilter(request.filter(), T::descriptor()));
  store::ListFilter<T> filter;
  filter.text = request.filter();
  if constexpr (requires { request.show_deleted(); }) filter.show_deleted = request.show_deleted();
  filter.belongs = [belongs](const T& item) { return belongs(item); };
  return filter;
}

// A page into the fields of any List reply.
template <typename T, typename Response>
Response ToResponse(store::Page<T> page,
                    google::protobuf::RepeatedPtrField<T>* (Response::*items)()) {
  Response response;
  for (T& item : page.items) *(response.*items)()->Add() = std::move(item);
  response.set_next_page_token(std::move(page.next_page_token));
  return response;
}

}  // namespace truepose::services
