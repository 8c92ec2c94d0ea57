// The tests have a cache of their own, so that results of an earlier build are not used.

#include <gtest/gtest.h>

#include <memory>

#include "support/environment.h"
#include "support/temporary_directory.h"

namespace {

class OwnCache : public testing::Environment {
  public:
    void SetUp() override {
        directory_ = std::make_unique<dermis::TemporaryDirectory>();
        cache_ = std::make_unique<dermis::EnvironmentVariable>("DERMIS_CACHE", directory_->path.string());
    }
    void TearDown() override {
        cache_.reset();
        directory_.reset();
    }

  private:
    std::unique_ptr<dermis::TemporaryDirectory> directory_;
    std::unique_ptr<dermis::EnvironmentVariable> cache_;
};

testing::Environment* const kOwnCache = testing::AddGlobalTestEnvironment(new OwnCache);

}  // namespace
