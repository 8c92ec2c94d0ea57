// The tests have a cache of their own, so that results of an earlier build are not used.

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "support/temporary_directory.h"

namespace {

class OwnCache : public testing::Environment {
  public:
    void SetUp() override {
        directory_ = std::make_unique<dermis::TemporaryDirectory>();
        ::setenv("DERMIS_CACHE", directory_->path.c_str(), 1);
    }
    void TearDown() override { directory_.reset(); }

  private:
    std::unique_ptr<dermis::TemporaryDirectory> directory_;
};

testing::Environment* const kOwnCache = testing::AddGlobalTestEnvironment(new OwnCache);

}  // namespace
