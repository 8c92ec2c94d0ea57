// What of WebGL 2 the page needs: programs from parts of text, textures, vertex arrays.

export function createContext(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: true, alpha: false });
  if (!gl) throw new Error("This browser has no WebGL 2, or it is switched off. Firefox, Chrome and Safari 15 have it.");
  return gl;
}

function compile(gl, type, name, parts) {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2DArray;\n" +
    "precision highp samplerCube;\n" + parts.join("\n"));
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
    throw new Error(`The shader ${name} does not compile here: ${gl.getShaderInfoLog(shader)}`);
  return shader;
}

// The program, and where its uniforms are, by name.
export function createProgram(gl, name, vertexParts, fragmentParts) {
  const program = gl.createProgram();
  gl.attachShader(program, compile(gl, gl.VERTEX_SHADER, name, vertexParts));
  gl.attachShader(program, compile(gl, gl.FRAGMENT_SHADER, name, fragmentParts));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(`The shader ${name} does not link here: ${gl.getProgramInfoLog(program)}`);
  const at = {};
  for (let i = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) - 1; i >= 0; --i) {
    const uniform = gl.getActiveUniform(program, i).name.replace("[0]", "");
    at[uniform] = gl.getUniformLocation(program, uniform);
  }
  return { program, at };
}

function createTexture(gl, target, filter, wrap) {
  const texture = gl.createTexture();
  gl.bindTexture(target, texture);
  gl.texParameteri(target, gl.TEXTURE_MIN_FILTER, filter);
  gl.texParameteri(target, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
  gl.texParameteri(target, gl.TEXTURE_WRAP_S, wrap);
  gl.texParameteri(target, gl.TEXTURE_WRAP_T, wrap);
  return texture;
}

// `wrap`: what the map has beyond its edges along u and v.
export function mapTexture(gl, image, isColor, wrap) {
  const texture = createTexture(gl, gl.TEXTURE_2D, gl.LINEAR_MIPMAP_LINEAR, gl.REPEAT);
  const modes = { repeat: gl.REPEAT, clamp: gl.CLAMP_TO_EDGE, mirror: gl.MIRRORED_REPEAT };
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, modes[wrap[0]]);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, modes[wrap[1]]);
  gl.texImage2D(gl.TEXTURE_2D, 0, isColor ? gl.SRGB8_ALPHA8 : gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, image);
  gl.generateMipmap(gl.TEXTURE_2D);
  const anisotropy = gl.getExtension("EXT_texture_filter_anisotropic");
  if (anisotropy)
    gl.texParameterf(gl.TEXTURE_2D, anisotropy.TEXTURE_MAX_ANISOTROPY_EXT,
      Math.min(8, gl.getParameter(anisotropy.MAX_TEXTURE_MAX_ANISOTROPY_EXT)));
  return texture;
}

export function texelTexture(gl, rgba) {
  const texture = createTexture(gl, gl.TEXTURE_2D, gl.LINEAR, gl.REPEAT);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(rgba));
  return texture;
}

// Layers of shared exponents, or of four halves.
export function arrayTexture(gl, buffer, { offset, width, height }, layers, isHalf) {
  const texture = createTexture(gl, gl.TEXTURE_2D_ARRAY, gl.LINEAR, gl.CLAMP_TO_EDGE);
  const count = width * height * layers;
  if (isHalf)
    gl.texImage3D(gl.TEXTURE_2D_ARRAY, 0, gl.RGBA16F, width, height, layers, 0, gl.RGBA, gl.HALF_FLOAT,
      new Uint16Array(buffer, offset, count * 4));
  else
    gl.texImage3D(gl.TEXTURE_2D_ARRAY, 0, gl.RGB9_E5, width, height, layers, 0, gl.RGB, gl.UNSIGNED_INT_5_9_9_9_REV,
      new Uint32Array(buffer, offset, count));
  return texture;
}

// Levels large to small, six faces in each.
export function cubeTexture(gl, buffer, { offset, side, levels }) {
  const texture = createTexture(gl, gl.TEXTURE_CUBE_MAP, gl.LINEAR_MIPMAP_LINEAR, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_CUBE_MAP, gl.TEXTURE_MAX_LEVEL, levels - 1);
  let at = offset;
  for (let level = 0; level < levels; ++level) {
    const size = Math.max(side >> level, 1);
    for (let face = 0; face < 6; ++face, at += 4 * size * size)
      gl.texImage2D(gl.TEXTURE_CUBE_MAP_POSITIVE_X + face, level, gl.RGB9_E5, size, size, 0, gl.RGB,
        gl.UNSIGNED_INT_5_9_9_9_REV, new Uint32Array(buffer, at, size * size));
  }
  return texture;
}

export function halfPairTexture(gl, buffer, { offset, side }) {
  const texture = createTexture(gl, gl.TEXTURE_2D, gl.LINEAR, gl.CLAMP_TO_EDGE);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RG16F, side, side, 0, gl.RG, gl.HALF_FLOAT, new Uint16Array(buffer, offset, side * side * 2));
  return texture;
}

// Depth alone, read as a comparison.
export function createShadowMap(gl, side) {
  const texture = createTexture(gl, gl.TEXTURE_2D, gl.LINEAR, gl.CLAMP_TO_EDGE);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, side, side);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_FUNC, gl.LEQUAL);
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, texture, 0);
  gl.drawBuffers([gl.NONE]);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  return { side, texture, framebuffer };
}

// Vertices of 36 bytes: dermis/engines/web/geometry.cpp.
export function vertexArray(gl, buffer, { vertices, indices }) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, new Uint8Array(buffer, vertices.offset, vertices.count * 36), gl.STATIC_DRAW);
  const layout = [[4, gl.UNSIGNED_SHORT, true, 0], [4, gl.SHORT, true, 8], [4, gl.BYTE, true, 16], [2, gl.UNSIGNED_SHORT, true, 20],
    [4, gl.HALF_FLOAT, false, 24], [4, gl.UNSIGNED_BYTE, true, 32]];
  layout.forEach(([size, type, normalized, offset], i) => {
    gl.enableVertexAttribArray(i);
    gl.vertexAttribPointer(i, size, type, normalized, 36, offset);
  });
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint8Array(buffer, indices.offset, indices.count * indices.bytes), gl.STATIC_DRAW);
  gl.bindVertexArray(null);
  return array;
}
