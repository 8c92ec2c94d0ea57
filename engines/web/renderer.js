// Draws the scene: the key light's shadow map, then the picture.

import * as gpu from "./gpu.js";
import * as load from "./load.js";
import { createMotion } from "./motion.js";
import { add, direction, length, lookAlong, multiply, normalize, orthographic, perspective, scale, subtract } from "./matrix.js";

const kShadowMapSide = 2048, kNoMap = [255, 255, 255, 255];

async function loadPrograms(gl) {
  const names = ["skin.essl", "shared.glsl", "light.glsl", "skin.vert", "skin.frag", "shadow.vert", "shadow.frag",
    "background.vert", "background.frag"];
  const texts = await Promise.all(names.map(load.text));
  const text = Object.fromEntries(names.map((name, i) => [name, texts[i]]));
  return {
    skin: gpu.createProgram(gl, "skin", [text["skin.vert"]],
      [text["skin.essl"], text["shared.glsl"], text["light.glsl"], text["skin.frag"]]),
    shadow: gpu.createProgram(gl, "shadow", [text["shadow.vert"]], [text["shadow.frag"]]),
    background: gpu.createProgram(gl, "background", [text["background.vert"]], [text["shared.glsl"], text["background.frag"]])
  };
}

async function loadMaps(gl, objects) {
  const paths = new Map();
  for (const object of objects)
    for (const part of object.parts)
      for (const [name, path] of Object.entries(part.material.maps))
        paths.set(path, { isColor: name === "albedo", wrap: part.material.wraps?.[name] ?? ["repeat", "repeat"] });
  const textures = await Promise.all([...paths].map(async ([path, { isColor, wrap }]) =>
    [path, gpu.mapTexture(gl, await load.image(path), isColor, wrap)]));
  return new Map(textures);
}

export async function createRenderer(canvas) {
  const gl = gpu.createContext(canvas);
  const [scene, buffer, programs] = await Promise.all([load.json("scene.json"), load.bytes("scene.bin"), loadPrograms(gl)]);
  const moves = scene.objects.some(({ motion }) => motion);
  const [maps, motionBuffer] = await Promise.all([loadMaps(gl, scene.objects), moves ? load.bytes("motion.bin") : null]);
  const { tables, environment } = scene, arrays = scene.objects.map(object => gpu.vertexArray(gl, buffer, object));
  const motion = moves ? createMotion(gl, scene, motionBuffer, arrays) : null;
  return new Renderer(canvas, gl, scene, programs, motion, {
    maps,
    noMap: gpu.texelTexture(gl, kNoMap),
    arrays,
    diffuse: gpu.arrayTexture(gl, buffer, tables.diffuse, scene.tones.length, false),
    rows: gpu.arrayTexture(gl, buffer, tables.rows, scene.tones.length, true),
    cube: gpu.cubeTexture(gl, buffer, environment.cube),
    brdf: gpu.halfPairTexture(gl, buffer, environment.brdf),
    shadowMap: gpu.createShadowMap(gl, kShadowMapSide)
  });
}

class Renderer {
  // motion: of createMotion(), null where nothing moves.
  constructor(canvas, gl, scene, programs, motion, resources) {
    Object.assign(this, { canvas, gl, scene, programs, motion, resources });
  }

  get radius_mm() { return this.motion?.radius_mm ?? this.scene.bounds.radius_mm; }

  // state: tone, wipe (0 to 1), showCurvature, yaw and pitch of the key light, eye and target in mm.
  draw(state) {
    const { gl, canvas } = this;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    canvas.width = Math.max(Math.round(canvas.clientWidth * ratio), 1);
    canvas.height = Math.max(Math.round(canvas.clientHeight * ratio), 1);
    const toKey = direction(state.yaw, state.pitch), lightMatrix = this.drawShadowMap(toKey);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.drawBackground();
    this.drawScene(state, toKey, lightMatrix);
  }

  drawShadowMap(toKey) {
    const { gl, scene: { bounds }, resources: { shadowMap } } = this;
    const r = this.radius_mm;
    const view = lookAlong(add(bounds.center_mm, scale(toKey, 2 * r)), scale(toKey, -1));
    const matrix = multiply(orthographic(r, r, 3 * r), view);
    const { program, at } = this.programs.shadow;
    gl.bindFramebuffer(gl.FRAMEBUFFER, shadowMap.framebuffer);
    gl.viewport(0, 0, shadowMap.side, shadowMap.side);
    gl.enable(gl.DEPTH_TEST);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.useProgram(program);
    gl.uniformMatrix4fv(at.view_projection, false, matrix);
    this.scene.objects.forEach((object, i) => {
      this.setBox(at, object);
      gl.bindVertexArray(this.resources.arrays[i]);
      for (const part of object.parts) this.drawPart(object, part);
    });
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return matrix;
  }

  drawBackground() {
    const { gl, scene } = this, { program, at } = this.programs.background;
    gl.disable(gl.DEPTH_TEST);
    gl.useProgram(program);
    gl.uniform3fv(at.background_linear, scene.background_linear);
    gl.uniform1f(at.exposure, scene.exposure);
    gl.uniform1i(at.tone_map, scene.tone_map);
    gl.bindVertexArray(null);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.DEPTH_TEST);
  }

  drawScene(state, toKey, lightMatrix) {
    const { gl, scene } = this, { program, at } = this.programs.skin;
    gl.useProgram(program);
    this.setCamera(at, state);
    this.setLights(at, toKey, lightMatrix);
    this.setEnvironment(at);
    this.setTone(at, state);
    scene.objects.forEach((object, i) => {
      this.setBox(at, object);
      gl.uniform2fv(at.uv_low, object.uv.low);
      gl.uniform2fv(at.uv_size, object.uv.size);
      gl.bindVertexArray(this.resources.arrays[i]);
      for (const part of object.parts) {
        this.setMaterial(at, part.material, scene.tones[state.tone]);
        this.drawPart(object, part);
      }
    });
  }

  drawPart(object, part) {
    const { bytes } = object.indices;
    this.gl.drawElements(this.gl.TRIANGLES, part.count, bytes === 4 ? this.gl.UNSIGNED_INT : this.gl.UNSIGNED_SHORT, part.first * bytes);
  }

  setBox(at, object) {
    this.gl.uniform3fv(at.box_low_mm, object.position_mm.low);
    this.gl.uniform3fv(at.box_size_mm, object.position_mm.size);
    this.gl.uniform1i(at.moves, Boolean(object.motion));
  }

  // A narrow picture sees as much of the head across as a square one.
  setCamera(at, { eye, target, wipe, showCurvature }) {
    const { gl, canvas, scene } = this;
    const aspect = canvas.width / canvas.height, r = this.radius_mm;
    const fov = 2 * Math.atan(Math.tan(scene.camera.vertical_fov_rad / 2) / Math.min(aspect, 1));
    const distance = length(subtract(eye, scene.bounds.center_mm));
    const far = (distance + r) * 1.01, near = Math.max((distance - r) * 0.99, far * 1e-3);
    const view = lookAlong(eye, normalize(subtract(target, eye)));
    gl.uniformMatrix4fv(at.view_projection, false, multiply(perspective(fov, aspect, near, far), view));
    gl.uniform3fv(at.eye_mm, eye);
    gl.uniform1f(at.exposure, scene.exposure);
    gl.uniform1i(at.tone_map, scene.tone_map);
    gl.uniform1f(at.wipe_x, wipe * canvas.width);
    gl.uniform1i(at.show_curvature, showCurvature);
  }

  setLights(at, toKey, lightMatrix) {
    const { gl, scene } = this, lights = scene.lights;
    gl.uniform1i(at.light_count, lights.length);
    if (lights.length) {
      gl.uniform3fv(at.to_light, lights.flatMap(light => light.key ? toKey : light.to_light));
      gl.uniform3fv(at.irradiance_linear, lights.flatMap(light => light.irradiance_linear));
      gl.uniform1iv(at.casts_shadow, lights.map(light => Number(light.key)));
    }
    gl.uniformMatrix4fv(at.light_view_projection, false, lightMatrix);
    gl.uniform1f(at.shadow_texel_mm, 2 * this.radius_mm / this.resources.shadowMap.side);
    gl.uniform1f(at.penumbra_mm, scene.penumbra_mm);
    gl.uniform1f(at.shadow_width_mm, scene.shadow_width_mm);
    this.bind(at.shadow_map, 0, gl.TEXTURE_2D, this.resources.shadowMap.texture);
  }

  setEnvironment(at) {
    const { gl, scene: { environment }, resources } = this, { cube } = environment;
    gl.uniform3fv(at.radiance_sh, environment.radiance_sh.flat());
    gl.uniform1f(at.environment_intensity, environment.intensity);
    gl.uniform1f(at.environment_yaw_rad, environment.yaw_rad);
    gl.uniform2f(at.environment_levels, cube.levels + cube.first_level, cube.first_level);
    this.bind(at.environment_cube, 1, gl.TEXTURE_CUBE_MAP, resources.cube);
    this.bind(at.environment_brdf, 2, gl.TEXTURE_2D, resources.brdf);
  }

  setTone(at, { tone }) {
    const { gl, scene, resources } = this;
    gl.uniform1f(at.skin_tone, tone);
    gl.uniform1f(at.max_curvature_per_mm, scene.tables.diffuse.max_curvature_per_mm);
    gl.uniformMatrix3fv(at.occlusion_weights, false, scene.tones[tone].occlusion_weights.flat());
    gl.uniformMatrix3fv(at.gain_form_mm, false, scene.tones[tone].gain_form_mm.flat());
    this.bind(at.diffuse_table, 3, gl.TEXTURE_2D_ARRAY, resources.diffuse);
    this.bind(at.rows_table, 4, gl.TEXTURE_2D_ARRAY, resources.rows);
  }

  setMaterial(at, material, tone) {
    const { gl } = this;
    const tint = material.skin ? tone.albedo_tint_linear : [1, 1, 1];
    gl.uniform1i(at.is_skin, material.skin);
    gl.uniform3fv(at.albedo_linear, material.albedo_linear.map((x, i) => x * tint[i]));
    gl.uniform1f(at.roughness_scale, material.roughness);
    gl.uniform1f(at.f0, material.f0);
    gl.uniform1i(at.normal_space, material.normal_space);
    gl.uniform1f(at.normal_scale, material.normal_scale);
    ["albedo", "normal", "surface"].forEach((name, i) => {
      const texture = material.maps[name] ? this.resources.maps.get(material.maps[name]) : this.resources.noMap;
      this.bind(at[name + "_map"], 5 + i, gl.TEXTURE_2D, texture);
    });
  }

  bind(location, unit, target, texture) {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(target, texture);
    gl.uniform1i(location, unit);
  }
}
