// The suite that every backend of the store has to pass. A TEST_P(StoreConformance, ...) runs once
// a backend.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "server/store/store.h"
#include "tests/store/testing/fake_clock.h"
#include "tests/store/testing/samples.h"
#include "tests/store/testing/temporary_folder.h"

namespace truepose::store {

enum class Backend { kSqliteMemory, kSqliteFile };

class StoreConformance : public ::testing::TestWithParam<Backend> {
 protected:
  void SetUp() override {
    StoreOptions options;
    options.path = GetParam() == Backend::kSqliteMemory ? ":memory:" : folder_.Path("store.db");
    options.clock = &clock_;
    auto store = Store::Open(options);
    ASSERT_TRUE(store.ok()) << store.status();
    store_ = *std::move(store);
  }

  template <typename Closure>
  auto Write(Closure closure) {
    return store_->Write(closure);
  }
  template <typename Closure>
  auto Read(Closure closure) {
    return store_->Read(closure);
  }

  TemporaryFolder folder_;
  FakeClock clock_;
  std::unique_ptr<Store> store_;
};

}  // namespace truepose::store
