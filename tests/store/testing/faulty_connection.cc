#include "tests/store/testing/faulty_connection.h"

#include <utility>

#include "core/base/status_macros.h"

namespace truepose::store {

absl::Status FaultPlan::Count(std::string_view sql) {
  if (!sql.starts_with(only)) return absl::OkStatus();
  return ++statements == fault_at ? fault() : absl::OkStatus();
}

namespace {

class FaultyStatement : public sql::Statement {
 public:
  FaultyStatement(std::unique_ptr<Statement> inner, std::string sql,
                  std::shared_ptr<FaultPlan> plan)
      : inner_(std::move(inner)), sql_(std::move(sql)), plan_(std::move(plan)) {}

  void BindInt64(int index, int64_t value) override { inner_->BindInt64(index, value); }
  void BindDouble(int index, double value) override { inner_->BindDouble(index, value); }
  void BindText(int index, std::string_view value) override { inner_->BindText(index, value); }
  void BindBlob(int index, std::string_view value) override { inner_->BindBlob(index, value); }
  absl::StatusOr<bool> Step() override {
    // Further rows belong to the same statement.
    if (!std::exchange(running_, true)) TRUEPOSE_RETURN_IF_ERROR(plan_->Count(sql_));
    return inner_->Step();
  }
  void Reset() override {
    running_ = false;
    inner_->Reset();
  }
  int64_t Int64(int column) const override { return inner_->Int64(column); }
  double Double(int column) const override { return inner_->Double(column); }
  std::string Text(int column) const override { return inner_->Text(column); }
  std::string Blob(int column) const override { return inner_->Blob(column); }

 private:
  const std::unique_ptr<Statement> inner_;
  const std::string sql_;
  const std::shared_ptr<FaultPlan> plan_;
  bool running_ = false;
};

class FaultyConnection : public sql::Connection {
 public:
  FaultyConnection(std::unique_ptr<Connection> inner, std::shared_ptr<FaultPlan> plan)
      : inner_(std::move(inner)), plan_(std::move(plan)) {}

  absl::StatusOr<std::unique_ptr<sql::Statement>> Prepare(std::string_view sql) override {
    TRUEPOSE_ASSIGN_OR_RETURN(std::unique_ptr<sql::Statement> statement, inner_->Prepare(sql));
    return std::make_unique<FaultyStatement>(std::move(statement), std::string(sql), plan_);
  }
  absl::Status Execute(std::string_view sql) override {
    TRUEPOSE_RETURN_IF_ERROR(plan_->Count(sql));
    return inner_->Execute(sql);
  }
  absl::Status Begin(sql::Access access) override {
    TRUEPOSE_RETURN_IF_ERROR(plan_->Count("BEGIN"));
    return inner_->Begin(access);
  }
  absl::StatusOr<int64_t> SchemaVersion() override {
    TRUEPOSE_RETURN_IF_ERROR(plan_->Count("schema version"));
    return inner_->SchemaVersion();
  }
  absl::Status SetSchemaVersion(int64_t version) override {
    TRUEPOSE_RETURN_IF_ERROR(plan_->Count("schema version"));
    return inner_->SetSchemaVersion(version);
  }

 private:
  const std::unique_ptr<Connection> inner_;
  const std::shared_ptr<FaultPlan> plan_;
};

}  // namespace

sql::Decorator Faulty(std::shared_ptr<FaultPlan> plan) {
  return [plan = std::move(plan)](
             std::unique_ptr<sql::Connection> inner) -> std::unique_ptr<sql::Connection> {
    return std::make_unique<FaultyConnection>(std::move(inner), plan);
  };
}

}  // namespace truepose::store
