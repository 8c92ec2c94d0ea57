#pragma once
// Changes by the user survive the reloading of the scene's files. A look is a scene
// without its objects (without_objects()).

#include "dermis/scene/scene.h"

namespace dermis::view {

/// A scene whose files were read again keeps what the user has changed since (`seen`), except where the file
/// now says something else than it did (`file_before`).
void keep_look(const Scene& file_before, const Scene& seen, Scene& fresh);

/// All of `seen`: for files that say nothing of it, such as meshes, whose new size moves the camera.
void put_look(const Scene& seen, Scene& fresh);

}  // namespace dermis::view
