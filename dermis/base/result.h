#pragma once
// Result<T>: a value, or one line for the user: what is wrong with the input, where, and what is right.
//
// For bad input, files and devices; broken assumptions are asserts. Nothing here throws.
//
//     Result<void> copy(const std::string& from, const std::string& to) {
//         DERMIS_TRY_ASSIGN(const Image image, read_image(from));  // returns the error, or has the value
//         DERMIS_TRY(check_size(image));
//         return write_image(to, image);
//     }

#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>

/// Returns the error of a Result from this function; otherwise continues.
#define DERMIS_TRY(...) \
    if (const auto dermis_tried = (__VA_ARGS__); !dermis_tried) return dermis_tried.error()
/// Two statements, for a block: returns the error, or gives the value to a new or declared variable.
#define DERMIS_TRY_ASSIGN(declaration, ...) \
    DERMIS_TRY_NAMED(DERMIS_JOIN(dermis_tried_, __LINE__), declaration, __VA_ARGS__)
#define DERMIS_TRY_NAMED(name, declaration, ...) \
    auto name = __VA_ARGS__;                     \
    if (!name) return name.error();              \
    declaration = *std::move(name)
#define DERMIS_JOIN(a, b) DERMIS_JOIN_EXPANDED(a, b)
#define DERMIS_JOIN_EXPANDED(a, b) a##b

namespace dermis::inline base {

/// Errors that a program handles; every other error is text for the user.
enum class ErrorCode {
    general,
    device_lost  ///< the GPU's driver crashed or timed out: a new device may work
};

/// One line for the user: the file, the place in it, how to correct it. No newline, no leading "error:".
struct Error {
    std::string message;
    ErrorCode code = ErrorCode::general;

    /// "PLACE: message"; the code stays.
    [[nodiscard]] Error within(const std::string& place) const { return {place + ": " + message, code}; }
};

template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    T& value() & { return assert(ok()), std::get<0>(state_); }
    const T& value() const& { return assert(ok()), std::get<0>(state_); }
    T&& value() && { return assert(ok()), std::get<0>(std::move(state_)); }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    [[nodiscard]] const Error& error() const { return assert(!ok()), std::get<1>(state_); }

  private:
    std::variant<T, Error> state_;
};

template <>
class [[nodiscard]] Result<void> {
  public:
    Result() = default;
    Result(Error error) : error_(std::move(error)) {}

    [[nodiscard]] bool ok() const { return !error_; }
    explicit operator bool() const { return ok(); }
    [[nodiscard]] const Error& error() const { return assert(error_), *error_; }

  private:
    std::optional<Error> error_;
};

}  // namespace dermis::inline base
