// gl_fallback: emulates the parts of OpenGL 4.5 that the passes use on contexts from 3.3 on. The passes are written
// once, against 4.5 with direct state access and fixed uniform locations. On older contexts load_gl() installs
// functions of the same names, which bind, do the work and restore the binding. Two things cannot be emulated on 3.3:
// fragment lists (see gl_has_lists) and glClipControl, for which shaders adjust their depths (render/gl/shader_text.h).
#pragma once

#include "render/gl/shader_text.h"

#include <glad/gl.h>

namespace ramus::render {

// For the context whose functions glad has just loaded. `version` as from GLAD_MAKE_VERSION. `context` identifies the
// context, since object names of different contexts are the same numbers.
void install_gl_fallback(int version, const void* context);

// Assigns a linked program the locations and bindings that its GLSL version cannot declare. Does nothing from 4.3 on.
void number_program(GLuint program, const ShaderText& vertex, const ShaderText& fragment);

} // namespace ramus::render
