#pragma once
// Result<T>: a value, or one line that says what was wrong with the input, where, and what would be right.
//
// For bad input, files and devices only; a broken assumption of ours is an assert. Nothing here throws.
//
//     Result<Image> image = read_image(path);
//     if (!image) return image.error();
//     use(*image);

#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace dermis {

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

}  // namespace dermis
