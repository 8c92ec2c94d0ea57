// How GLSL and WGSL write what differs between them: the texts of the plugin are functions of one of the two.

const parameters = (list, one) => list.map(([type, name]) => one(type, name)).join(", ");

export const glsl = {
  local: (type, name) => `${type} ${name}`,
  global: (type, name) => `${type} ${name};`,
  toFloat: name => `float(${name})`,
  method: (type, name, ...list) => `${type} ${name}(${parameters(list, (kind, one) => `${kind} ${one}`)})`,
  count: (name, end) => `for (int ${name} = 0; ${name} < ${end}; ++${name})`,
  select: (condition, yes, no) => `(${condition} ? ${yes} : ${no})`,
  varying: (type, name) => `varying ${type} ${name};`,
  attribute: (type, name) => `attribute ${type} ${name};`,
  map: name => `uniform sampler2D ${name};`,
  read: (map, place) => `texture2D(${map}, ${place})`,
  readLevel: (map, place, level) => `textureLod(${map}, ${place}, ${level})`,
  // A shadow map as a parameter and as what is passed on.
  shadowParameter: [["highp sampler2DShadow", "map"]],
  shadowMap: name => name,
  own: name => name,       // a uniform of the material
  input: name => name,     // what the vertices give
  given: name => name,     // an attribute
  output: name => name,    // to the fragments
  across: name => `dFdx(${name})`,
  down: name => `dFdy(${name})`,
  root: "inversesqrt",
  rotation: "mat3(world)",
  pixel: "gl_FragCoord",
};

const kTypes = { float: "f32", int: "i32", vec2: "vec2f", vec3: "vec3f", vec4: "vec4f", mat4: "mat4x4f" };
const wgslType = type => kTypes[type] ?? type;

export const wgsl = {
  local: (type, name) => `var ${name}: ${wgslType(type)}`,
  global: (type, name) => `var<private> ${name}: ${wgslType(type)};`,
  toFloat: name => `f32(${name})`,
  method: (type, name, ...list) => `fn ${name}(${parameters(list, (kind, one) => `${one}: ${wgslType(kind)}`)}) -> ${wgslType(type)}`,
  count: (name, end) => `for (var ${name} = 0; ${name} < ${end}; ${name}++)`,
  select: (condition, yes, no) => `select(${no}, ${yes}, ${condition})`,
  varying: (type, name) => `varying ${name}: ${wgslType(type)};`,
  attribute: (type, name) => `attribute ${name}: ${wgslType(type)};`,
  map: name => `var ${name}Sampler: sampler;\nvar ${name}: texture_2d<f32>;`,
  read: (map, place) => `textureSample(${map}, ${map}Sampler, ${place})`,
  readLevel: (map, place, level) => `textureSampleLevel(${map}, ${map}Sampler, ${place}, ${level})`,
  shadowParameter: [["texture_depth_2d", "map"], ["sampler_comparison", "mapSampler"]],
  shadowMap: name => `${name}, ${name}Sampler`,
  own: name => `uniforms.${name}`,
  input: name => `fragmentInputs.${name}`,
  given: name => `vertexInputs.${name}`,
  output: name => `vertexOutputs.${name}`,
  across: name => `dpdx(${name})`,
  down: name => `dpdy(${name})`,
  root: "inverseSqrt",
  rotation: "mat3x3f(mesh.world[0].xyz, mesh.world[1].xyz, mesh.world[2].xyz)",
  pixel: "fragmentInputs.position",
};
