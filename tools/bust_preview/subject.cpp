#include "subject.h"

#include <cstdio>
#include <sstream>

#include "dermis/base/file.h"
#include "dermis/base/parallel.h"
#include "subjects/bust/head_mesh.h"

namespace dermis::preview {

using namespace bust;

namespace {

const std::vector<View> kViews = {
    {"front", 0, 0, {0, -10, 0}, 330, {-0.55, 0.65, 0.75}},
    {"quarter", 38, 4, {0, -10, 0}, 330, {-0.35, 0.65, 0.75}},
    {"profile", 90, 0, {0, -10, 5}, 330, {0.35, 0.6, 0.85}},
    {"back", 160, 8, {0, -20, 0}, 330, {0.6, 0.6, -0.6}},
    {"whole", 25, 2, {0, -40, 0}, 400, {-0.45, 0.65, 0.75}},
    {"wholeback", 150, 5, {0, -40, 0}, 400, {0.6, 0.6, -0.6}},
    {"ear", 75, 5, {75, 4, 0}, 95, {0.5, 0.6, 0.7}},
    {"earback", 150, 5, {75, 4, 0}, 95, {0.7, 0.6, -0.4}},
    {"earfront", 15, 5, {75, 4, 0}, 95, {0.3, 0.6, 0.7}},
    {"earlight", 38, 3, {80, 4, 0}, 105, {0.16, 0.22, -0.96}},
    {"eye", 12, 2, {31, 22, 90}, 75, {-0.55, 0.65, 0.75}},
    {"eyeside", 60, 2, {31, 22, 90}, 75, {0.15, 0.75, 0.75}},
    {"mouth", 0, 0, {0, -40, 105}, 90, {-0.55, 0.65, 0.75}},
    {"mouth34", 40, 0, {0, -40, 105}, 90, {-0.35, 0.65, 0.75}},
    {"nose", 0, 0, {0, 0, 110}, 90, {-0.55, 0.65, 0.75}},
    {"nose34", 45, -8, {0, 0, 110}, 90, {-0.35, 0.65, 0.75}},
    {"nosebelow", 15, -40, {0, 0, 110}, 90, {-0.35, 0.65, 0.75}},
    {"face", 0, 0, {0, 0, 90}, 190, {-0.55, 0.65, 0.75}},
    {"face34", 35, 0, {20, 0, 80}, 190, {-0.35, 0.65, 0.75}},
    {"below", 20, -35, {0, -20, 40}, 280, {-0.35, 0.65, 0.75}},
    {"top", 20, 50, {0, 20, 0}, 280, {-0.35, 0.65, 0.75}},
};

std::vector<Point> field_normals(const BustField& field, const Surface& mesh) {
    std::vector<Point> normals(mesh.points.size());
    parallel_for(normals.size(), 512, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) normals[i] = field.normal(mesh.points[i]);
    });
    return normals;
}

std::vector<Point> face_normals(const Surface& mesh) {
    std::vector<Point> normals(mesh.points.size());
    for (const auto& t : mesh.triangles) {
        const Point a = mesh.points[size_t(t[0])];
        const Point n = cross(mesh.points[size_t(t[1])] - a, mesh.points[size_t(t[2])] - a);
        for (const int k : t) normals[size_t(k)] = normals[size_t(k)] + n;
    }
    return normals;
}

}  // namespace

const View* find_view(const std::string& name) {
    for (const View& view : kViews)
        if (view.name == name) return &view;
    return nullptr;
}

std::string view_names() {
    std::string names;
    for (const View& view : kViews) names += (names.empty() ? "" : " ") + view.name;
    return names;
}

Result<Subject> skin_subject(const BustParams& params) {
    Result<Bust> bust = build_bust(params, kBustMapSide);
    if (!bust) return bust.error();
    Subject s;
    for (const Vec3& p : bust->mesh.positions_mm) s.mesh.points.push_back({p.x, p.y, p.z});
    for (const Vec3& n : bust->mesh.normals) s.normals.push_back({n.x, n.y, n.z});
    const std::vector<uint32_t>& i = bust->mesh.indices;
    for (size_t k = 0; k < i.size(); k += 3)
        s.mesh.triangles.push_back({int(i[k]), int(i[k + 1]), int(i[k + 2])});
    s.skin = std::move(*bust);
    s.skin->albedo = to_linear_float(s.skin->albedo);
    return s;
}

Subject clay_subject(const BustParams& params) {
    const BustField field(params);
    Subject s = {.mesh = make_head_surface(field), .normals = {}, .skin = {}, .field = {}};
    s.normals = field_normals(field, s.mesh);
    // Two for a sphere: less means a tunnel, which cannot be flattened.
    std::printf("%zu triangles, Euler characteristic %ld\n", s.mesh.triangles.size(),
                long(s.mesh.points.size()) - long(s.mesh.triangles.size() / 2));
    return s;
}

Subject sketch_subject(const BustParams& params) {
    Subject s = {.mesh = {}, .normals = {}, .skin = {}, .field = BustField(params)};
    const auto distance = [&](Point p) { return s.field->distance_mm(p); };
    s.mesh = extract_surface(distance, kBustBox, 2.5);
    parallel_for(s.mesh.points.size(), 256, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) s.mesh.points[i] = s.field->project(s.mesh.points[i], 1);
    });
    s.normals = face_normals(s.mesh);
    return s;
}

Subject crop_subject(const BustParams& params, const View& view) {
    const BustField field(params);
    const double r = view.width_mm * 0.6;
    const Box box = {view.target - Point{r, r, r}, view.target + Point{r, r, r}};
    const auto distance = [&](Point p) { return field.distance_mm(p); };
    Subject s = {
        .mesh = extract_surface(distance, box, view.width_mm / 110), .normals = {}, .skin = {}, .field = {}};
    parallel_for(s.mesh.points.size(), 256, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) s.mesh.points[i] = field.project(s.mesh.points[i], 2);
    });
    s.normals = field_normals(field, s.mesh);
    return s;
}

Result<Subject> obj_subject(const std::string& path, double mm_per_unit) {
    const Result<std::string> text = read_text_file(path);
    if (!text) return text.error();
    Subject s;
    Point low = {1e9, 1e9, 1e9}, high = low * -1;
    std::istringstream file(*text);
    for (std::string line; std::getline(file, line);) {
        std::istringstream in(line);
        std::string key;
        in >> key;
        if (key == "v") {
            Point p;
            in >> p.x >> p.y >> p.z;
            p = p * mm_per_unit;
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            s.mesh.points.push_back(p);
        } else if (key == "f") {
            std::vector<int> face;
            for (std::string corner; in >> corner;) face.push_back(std::atoi(corner.c_str()) - 1);
            for (const int i : face)
                if (i < 0 || i >= int(s.mesh.points.size()))
                    return Error{path + ": a face names a vertex that is not there"};
            for (size_t k = 2; k < face.size(); ++k)
                s.mesh.triangles.push_back({face[0], face[k - 1], face[k]});
        }
    }
    for (Point& p : s.mesh.points) p = p - Point{(low.x + high.x) / 2, high.y - 135, high.z - 130};
    s.normals = face_normals(s.mesh);
    return s;
}

}  // namespace dermis::preview
