#pragma once
// Between numpy's arrays and the libraries' values. What goes out is a view of memory that C++ owns, kept
// alive by the array; what comes in is checked and copied, whatever its strides and byte order.

#include <array>
#include <string>
#include <vector>

#include "calls.h"
#include "dermis/base/vec.h"
#include "dermis/image/image.h"

namespace dermis::python {

/// Takes the vector over: no copy. The array's own, writable.
template <class T>
py::array_t<T> array_of(std::vector<T> values, std::vector<py::ssize_t> shape) {
    auto* owned = new std::vector<T>(std::move(values));
    const py::capsule owner(owned, [](void* p) { delete static_cast<std::vector<T>*>(p); });
    return py::array_t<T>(std::move(shape), owned->data(), owner);
}

/// A read-only view of memory that `owner` keeps alive: no copy.
template <class T>
py::array_t<T> view_of(const T* data, std::vector<py::ssize_t> shape, const py::object& owner) {
    py::array_t<T> view(std::move(shape), data, owner);
    view.attr("setflags")(py::arg("write") = false);
    return view;
}

/// H x W x channels, or H x W of one channel. 32-bit floats and integers without a copy; 16-bit floats become
/// 32-bit ones.
[[nodiscard]] py::array array_of(Image image);
/// The same as a read-only view of an image that `owner` keeps alive; not of 16-bit floats.
[[nodiscard]] py::array view_of(const Image& image, const py::object& owner);

/// A picture of linear light, H x W x 3, or H x W (x 1) of one channel: floats of 16, 32 or 64 bits. The
/// error begins with `name` and says what is wrong with the shape or dtype.
[[nodiscard]] Image picture_from(const py::object& array, const std::string& name);
/// H x W: floats, integers or bools. None is an empty image: no mask.
[[nodiscard]] Image mask_from(const py::object& array, const std::string& name);

/// Real finite numbers of `columns` a row (0: a plain list of numbers), any length but none; `columns` N: N x
/// columns. The error begins with `name`.
[[nodiscard]] std::vector<double> numbers_from(const py::object& array, const std::string& name,
                                               size_t columns = 0);
/// The same as 32-bit floats; one that is too large for them is an error.
[[nodiscard]] std::vector<float> floats_from(const py::object& array, const std::string& name,
                                             size_t columns);
/// Whole numbers from 0 to 2^32 - 1.
[[nodiscard]] std::vector<uint32_t> indices_from(const py::object& array, const std::string& name,
                                                 size_t columns);

[[nodiscard]] std::vector<Rgb> triples_of(const std::vector<double>& numbers);
[[nodiscard]] Rgb triple_from(const py::object& array, const std::string& name);

}  // namespace dermis::python
