#pragma once
// The built-in parts of a program, as plain data. The program passes it down from catalog/: no library
// names a technique, a subject or a technique's shader by name.

#include <span>

#include "dermis/gpu/executor.h"
#include "dermis/scene/subject.h"
#include "dermis/technique/technique.h"

namespace dermis::inline render {

/// Everything in it must outlive whatever it is given to.
struct Catalog {
    std::span<const Technique> techniques;  ///< by id
    std::span<const Subject> subjects;      ///< likewise
    std::span<const gpu::EmbeddedShader> shaders;
};

}  // namespace dermis::inline render
