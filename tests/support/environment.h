#pragma once
// A variable of the environment, for the time of a test.

#include <cstdlib>
#include <string>

namespace dermis {

class EnvironmentVariable {
  public:
    EnvironmentVariable(const char* name, const std::string& value) : name_(name) { set(value); }
    ~EnvironmentVariable() { set(""); }
    EnvironmentVariable(const EnvironmentVariable&) = delete;
    EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

  private:
    // Empty is unset.
    void set(const std::string& value) {
#ifdef _WIN32
        ::_putenv_s(name_.c_str(), value.c_str());
#else
        value.empty() ? ::unsetenv(name_.c_str()) : ::setenv(name_.c_str(), value.c_str(), 1);
#endif
    }
    std::string name_;
};

}  // namespace dermis
