// How far one picture is from another; and picture files as arrays.

#include "dermis/image/metrics.h"
#include "arrays.h"
#include "dermis/image/io.h"
#include "module.h"

namespace dermis::python {
namespace {

using Metric = Result<double> (*)(const Image&, const Image&, const Image&);

// NaN, sizes that differ and empty masks are errors of the metrics themselves.
double measure(Metric metric, const py::object& image, const py::object& reference, const py::object& mask) {
    const Image a = picture_from(image, "image"), b = picture_from(reference, "reference"),
                m = mask_from(mask, "mask");
    return value_of(unlocked([&] { return metric(a, b, m); }));
}

void add_metric(py::module_& module, const char* name, Metric metric) {
    module.def(name, [metric](const py::object& image, const py::object& reference, const py::object& mask) {
        return measure(metric, image, reference, mask);
    });
}

double flip(const py::object& image, const py::object& reference, const py::object& mask,
            double pixels_per_degree) {
    const Image a = picture_from(image, "image"), b = picture_from(reference, "reference"),
                m = mask_from(mask, "mask");
    return value_of(unlocked([&] { return mean_flip(a, b, m, pixels_per_degree); }));
}

py::array flip_picture(const py::object& image, const py::object& reference, double pixels_per_degree) {
    const Image a = picture_from(image, "image"), b = picture_from(reference, "reference");
    return array_of(value_of(unlocked([&] { return flip_map(a, b, pixels_per_degree); })));
}

// Linear light; integers of a file are decoded.
py::array read_picture_file(const std::string& path) {
    return array_of(value_of(unlocked([&]() -> Result<Image> {
        DERMIS_TRY_ASSIGN(const LoadedImage loaded, read_image(path, ImageUse::color));
        return to_linear_float(loaded.image);
    })));
}

}  // namespace

void add_metrics(py::module_& module) {
    add_metric(module, "max_abs_error", max_abs_error);
    add_metric(module, "rmse", rmse);
    add_metric(module, "rel_mse", rel_mse);
    add_metric(module, "psnr_db", psnr_db);
    add_metric(module, "ssim", ssim);
    add_metric(module, "ciede2000", mean_ciede2000);
    module.def("flip", flip);
    module.def("flip_map", flip_picture);
    module.def("read_image", read_picture_file);
}

}  // namespace dermis::python
