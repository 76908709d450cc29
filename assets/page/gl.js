// Small helpers over WebGL 2: programs with their uniforms, buffers, textures, targets.

/**
 * A program that is compiled at its first use. Returns a function that makes it current and sets its uniforms: numbers,
 * arrays, or textures for samplers; names that the program does not have are left out.
 */
export function makeProgram(gl, vertex, fragment) {
  let program = null;
  const places = new Map();
  const compile = () => {
    program = gl.createProgram();
    const shaders = [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]].map(([kind, text]) => {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      return shader;
    });
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error(`a shader does not compile: ${shaders.map((shader) => gl.getShaderInfoLog(shader)).join(" ")} ${gl.getProgramInfoLog(program)}`);
    const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
    for (let i = 0; i < count; ++i) {
      const info = gl.getActiveUniform(program, i);
      places.set(info.name.replace("[0]", ""), { at: gl.getUniformLocation(program, info.name), type: info.type });
    }
  };
  const set = {
    [gl.FLOAT]: (at, v) => gl.uniform1f(at, v), [gl.FLOAT_VEC2]: (at, v) => gl.uniform2fv(at, v),
    [gl.FLOAT_VEC3]: (at, v) => gl.uniform3fv(at, v), [gl.FLOAT_VEC4]: (at, v) => gl.uniform4fv(at, v),
    [gl.INT]: (at, v) => gl.uniform1i(at, v), [gl.UNSIGNED_INT]: (at, v) => gl.uniform1ui(at, v),
    [gl.INT_VEC2]: (at, v) => gl.uniform2iv(at, v),
    [gl.FLOAT_MAT3]: (at, v) => gl.uniformMatrix3fv(at, false, v), [gl.FLOAT_MAT4]: (at, v) => gl.uniformMatrix4fv(at, false, v),
  };
  return (values) => {
    if (!program) compile();
    gl.useProgram(program);
    let unit = 0;
    for (const [name, { at, type }] of places) {
      const value = values[name];
      if (value === undefined) continue;
      if (set[type]) set[type](at, value);
      else {
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, value);
        gl.uniform1i(at, unit++);
      }
    }
  };
}

/** A buffer with the content of a typed array. */
export function makeBuffer(gl, target, data, usage = gl.STATIC_DRAW) {
  const buffer = gl.createBuffer();
  gl.bindBuffer(target, buffer);
  gl.bufferData(target, data, usage);
  return buffer;
}

/** A texture without mipmaps; `format` is a sized internal format, `filter` gl.NEAREST or gl.LINEAR. */
export function makeTexture(gl, format, width, height, filter = gl.NEAREST) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
  for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
  for (const way of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, way, filter);
  return texture;
}

/** A framebuffer of colour textures and maybe a depth texture. */
export function makeTarget(gl, colours, depth = null) {
  const target = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  colours.forEach((texture, i) => gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, texture, 0));
  if (depth) gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, depth, 0);
  gl.drawBuffers(colours.map((_, i) => gl.COLOR_ATTACHMENT0 + i));
  return target;
}

/** sRGB "#rrggbb" to linear numbers from 0 to 1. */
export const linear = (colour) => srgb(colour).map(toLinear);

/** A channel of sRGB to linear light, both from 0 to 1. */
export const toLinear = (c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;

/** "#rrggbb" to numbers from 0 to 1; grey for anything else. */
export function srgb(colour) {
  const found = /^#([0-9a-f]{6})$/i.exec(colour || "");
  const bits = found ? parseInt(found[1], 16) : 0x999999;
  return [bits >> 16, (bits >> 8) & 255, bits & 255].map((c) => c / 255);
}
