// gl_floor: OpenGL 4.5's way of speaking on older contexts, from 3.3 on. The passes are written once, against 4.5:
// objects are named in calls instead of bound, uniforms have fixed locations. Where the context is older, load_gl()
// puts functions of the same names here, which bind, do and bind back. Not here, because 3.3 cannot do it at all: lists
// of fragments (see gl_has_lists) and glClipControl, instead of which shaders change their depths
// (render/gl/shader_text.h).
#pragma once

#include "render/gl/shader_text.h"

#include <glad/gl.h>

namespace ramus::render {

// For the context whose functions glad has just loaded; `version` as by GLAD_MAKE_VERSION, `context` tells contexts
// apart that live at the same time: their names are the same numbers.
void install_gl_floor(int version, const void* context);

// Gives a linked program the numbers that its text could not say. Nothing to do from 4.3 on.
void number_program(GLuint program, const ShaderText& vertex, const ShaderText& fragment);

} // namespace ramus::render
