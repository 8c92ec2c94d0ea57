#include "arrays.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "dermis/base/text.h"

namespace dermis::python {
namespace {

Failure refused(const std::string& name, const std::string& what) {
    return Failure({name + ": " + what});
}

std::string text_of(const py::handle& object) {
    return py::str(object).cast<std::string>();
}

std::string shape_text(const py::array& array) {
    std::string text;
    for (py::ssize_t i = 0; i < array.ndim(); ++i)
        text += (i == 0 ? "" : " x ") + std::to_string(array.shape(i));
    return array.ndim() == 0 ? "a single number" : text;
}

// Lists become arrays; what numpy cannot take is an error of numpy's own.
py::array any_array(const py::object& object, const std::string& name) {
    const py::array array = py::array::ensure(object);
    if (!array) {
        PyErr_Clear();
        throw refused(name, "no array of numbers");
    }
    return array;
}

void check_kind(const py::array& array, const std::string& name, std::string_view kinds, const char* wanted) {
    if (kinds.find(array.dtype().kind()) == std::string_view::npos)
        throw refused(name, "dtype " + text_of(array.dtype()) + ", must be " + wanted);
}

template <class T>
py::array_t<T> contiguous(const py::array& array, const std::string& name) {
    const auto converted = py::array_t<T, py::array::c_style | py::array::forcecast>::ensure(array);
    if (converted) return converted;
    PyErr_Clear();
    throw refused(name, "its numbers cannot be read");
}

// Rows of `columns` numbers, one row at least.
void check_rows(const py::array& array, const std::string& name, size_t columns) {
    const bool good =
        columns == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == py::ssize_t(columns);
    if (!good)
        throw refused(name, "shape " + shape_text(array) + ", must be N" +
                                (columns == 0 ? "" : " x " + std::to_string(columns)));
    if (array.shape(0) == 0) throw refused(name, "is empty");
}

void check_sides(const py::array& array, const std::string& name) {
    for (int axis : {0, 1})
        if (array.shape(axis) < 1 || array.shape(axis) > kMaxImageSide)
            throw refused(name, "shape " + shape_text(array) + ", each side must be 1 to " +
                                    std::to_string(kMaxImageSide));
}

Image float_image(const py::array& array, const std::string& name, int channels) {
    Image image(int(array.shape(1)), int(array.shape(0)), channels, PixelFormat::f32);
    const py::array_t<float> values = contiguous<float>(array, name);
    std::memcpy(image.bytes.data(), values.data(), image.bytes.size());
    return image;
}

py::array image_array(const Image& image, const py::object& owner) {
    std::vector<py::ssize_t> shape = {image.height, image.width};
    if (image.channels > 1) shape.push_back(image.channels);
    const void* data = image.bytes.data();
    switch (image.format) {
        case PixelFormat::u8:
            return py::array(py::dtype::of<uint8_t>(), shape, data, owner);
        case PixelFormat::u16:
            return py::array(py::dtype::of<uint16_t>(), shape, data, owner);
        default:
            return py::array(py::dtype::of<float>(), shape, data, owner);
    }
}

}  // namespace

py::array array_of(Image image) {
    if (image.format == PixelFormat::f16) image = to_linear_float(image);
    auto* owned = new Image(std::move(image));
    const py::capsule owner(owned, [](void* p) { delete static_cast<Image*>(p); });
    return image_array(*owned, owner);
}

py::array view_of(const Image& image, const py::object& owner) {
    py::array view = image_array(image, owner);
    view.attr("setflags")(py::arg("write") = false);
    return view;
}

Image picture_from(const py::object& object, const std::string& name) {
    const py::array array = any_array(object, name);
    check_kind(array, name, "f", "a float type: linear light, not codes of a display");
    const bool colour = array.ndim() == 3 && array.shape(2) == 3;
    const bool grey = array.ndim() == 2 || (array.ndim() == 3 && array.shape(2) == 1);
    if (!colour && !grey)
        throw refused(name,
                      "shape " + shape_text(array) + ", must be height x width x 3 (or height x width)");
    check_sides(array, name);
    return float_image(array, name, colour ? 3 : 1);
}

Image mask_from(const py::object& object, const std::string& name) {
    if (object.is_none()) return {};
    const py::array array = any_array(object, name);
    check_kind(array, name, "fiub", "numbers or bools");
    if (array.ndim() != 2) throw refused(name, "shape " + shape_text(array) + ", must be height x width");
    check_sides(array, name);
    return float_image(array, name, 1);
}

std::vector<double> numbers_from(const py::object& object, const std::string& name, size_t columns) {
    const py::array array = any_array(object, name);
    check_kind(array, name, "fiu", "real numbers");
    check_rows(array, name, columns);
    const py::array_t<double> values = contiguous<double>(array, name);
    const std::vector<double> numbers(values.data(), values.data() + values.size());
    for (size_t i = 0; i < numbers.size(); ++i)
        if (!std::isfinite(numbers[i]))
            throw refused(name, to_text(numbers[i]) + " in row " + std::to_string(columns ? i / columns : i) +
                                    " is not a finite number");
    return numbers;
}

std::vector<float> floats_from(const py::object& object, const std::string& name, size_t columns) {
    const std::vector<double> numbers = numbers_from(object, name, columns);
    std::vector<float> floats;
    floats.reserve(numbers.size());
    for (const double number : numbers) {
        if (std::abs(number) > double(std::numeric_limits<float>::max()))
            throw refused(name, to_text(number) + " is not a finite number");
        floats.push_back(float(number));
    }
    return floats;
}

std::vector<uint32_t> indices_from(const py::object& object, const std::string& name, size_t columns) {
    const py::array array = any_array(object, name);
    check_kind(array, name, "iu", "whole numbers");
    check_rows(array, name, columns);
    const py::array_t<double> values = contiguous<double>(array, name);  // exact up to 2^53
    std::vector<uint32_t> indices;
    indices.reserve(size_t(values.size()));
    for (const double* p = values.data(); p != values.data() + values.size(); ++p) {
        if (!(*p >= 0 && *p <= double(std::numeric_limits<uint32_t>::max())))
            throw refused(name, to_text(*p) + " is not an index");
        indices.push_back(uint32_t(*p));
    }
    return indices;
}

std::vector<Rgb> triples_of(const std::vector<double>& numbers) {
    std::vector<Rgb> triples(numbers.size() / 3);
    for (size_t i = 0; i < numbers.size(); ++i) triples[i / 3][i % 3] = numbers[i];
    return triples;
}

Rgb triple_from(const py::object& object, const std::string& name) {
    const std::vector<double> numbers = numbers_from(object, name);
    if (numbers.size() != 3)
        throw refused(name, std::to_string(numbers.size()) + " numbers, must be red, green, blue");
    return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace dermis::python
