// What scattering needs to know of the surface: curvature, normals of the channels, occlusion. All in the mesh's space; of a head that
// moves, in the space in which it was baked.

import { NoColorSpace, Vector2 } from "three/webgpu";
import {
  attribute, cameraWorldMatrix, cross, dFdx, dFdy, float, fwidth, materialReference, mix, modelViewMatrix, modelWorldMatrix, normalLocal, normalView,
  normalViewGeometry, positionView, tangentLocal, texture, transformNormal, uniform, uv, vec2, vec3, vec4,
} from "three/tsl";
import {
  bakedLevel, bakedSkin, band2OfMeans, curvatureAround, curvatureFromDerivatives, curvatureOfMean, curvatureTowards, meanCurvatureFromDerivatives,
  meanNormalBlue, meanNormalGreen, meanNormalRed, skinAmbientBand1, skinAmbientBand2, skinGain, sphereDiagonal, sphereMixed, spreadTowards,
  tangentDiagonal, tangentMixed, turned, vertexTangent,
} from "./SkinFunction.js";
import { maxCurvaturePerMm } from "./SkinTable.js";

// Attributes of a head of `dermis export`, as three.js names further texture coordinates.
export const headAttributes = ["uv1", "uv2", "uv3", "texcoord_4", "texcoord_5"];
const frameAttributes = ["texcoord_6", "texcoord_7"];

// The axes of the world in the space of the bakes, where the surface has turned since: of each vertex.
function axesOfWorld() {
  const frame = vec4(attribute("texcoord_6", "vec2"), attribute("texcoord_7", "vec2"));
  const n = transformNormal(normalLocal).toVar(), along = modelWorldMatrix.mul(vec4(tangentLocal, 0)).xyz.toVar();
  const t = along.sub(n.mul(n.dot(along))).normalize().toVar(), b = cross(n, t).toVar();
  // WebGPU guarantees 16 varyings: the third one follows.
  const [x, y] = ["x", "y"].map(axis => turned(frame, vec3(t[axis], b[axis], n[axis])).toVarying(`v_skinAxis_${axis}`));
  return [x, y, cross(x, y)].map(axis => axis.toVar());
}

// toMesh: a direction of the view in the mesh's space. inWorld: a vector of the mesh's space in the world.
function spacesOf(geometry) {
  if (!frameAttributes.every(name => geometry.hasAttribute(name)))
    return {
      toMesh: direction => vec4(direction, 0).mul(modelViewMatrix).xyz.normalize(),
      inWorld: vector => modelWorldMatrix.mul(vec4(vector, 0)).xyz,
    };
  const axes = axesOfWorld();
  return {
    toMesh: direction => {
      const world = cameraWorldMatrix.mul(vec4(direction, 0)).xyz.toVar();
      return axes[0].mul(world.x).add(axes[1].mul(world.y)).add(axes[2].mul(world.z)).normalize();
    },
    inWorld: vector => vec3(...axes.map(axis => axis.dot(vector))),
  };
}

function readBaked({ red, green, spread }, normal) {
  for (const map of [red, green, spread])
    if (map.colorSpace !== NoColorSpace)
      console.warn("SkinNodeMaterial.bakedNormals: the colorSpace of the maps has to be NoColorSpace: they hold directions, not colours.");
  const place = uv(1), size = uniform(new Vector2(red.image.width, red.image.height));
  const level = bakedLevel(dFdx(place).mul(size), dFdy(place).mul(size)).toVar();
  const [r, g, s] = [red, green, spread].map(map => texture(map, place).level(level).rgb.toVar());
  const skin = bakedSkin(r).toVar();
  const means = [meanNormalRed(r, s, normal), meanNormalGreen(r, g, s, normal), meanNormalBlue(r, g, s, normal)].map(mean => mean.toVar());
  const lengths = vec3(...means.map(mean => mean.length())).toVar();
  return {
    normals: means.map(mean => mean.normalize().toVar()),
    lengths,
    skin,
    uneven: s.xy.mul(2).sub(1).mul(skin).toVar(),
    curvature: curvatureOfMean(lengths.x),
  };
}

// material: a SkinNodeMaterial. geometry: has the attributes of a head or not.
export function readSurface(material, geometry) {
  const { toMesh, inWorld } = spacesOf(geometry);
  const normal = toMesh(normalViewGeometry).toVar("skinMeshNormal"), own = toMesh(normalView).toVar("skinOwnNormal");
  const gain = materialReference("curvatureGain", "float");
  const limited = curvature => curvature.mul(gain).min(maxCurvaturePerMm);
  const surface = { normal, own, toMesh, inWorld, toWorld: direction => inWorld(direction).normalize() };
  let mean = null;
  if (headAttributes.every(name => geometry.hasAttribute(name))) {
    const bends = vec4(attribute("uv2", "vec2"), attribute("uv3", "vec2")).toVarying("v_skinBends");
    const occlusion = vec4(attribute("texcoord_4", "vec2"), attribute("texcoord_5", "vec2")).toVarying("v_skinOcclusion");
    const perMm = bends.xyz.toVar(), t = vertexTangent(normal).toVar(), b = cross(normal, t).toVar();
    mean = perMm.x;
    surface.diagonal = tangentDiagonal(perMm, t, b).toVar();
    surface.mixed = tangentMixed(perMm, t, b).toVar();
    surface.occlusion = vec3(bends.w, occlusion.xy);
    surface.plainOcclusion = occlusion.z;
    surface.curvature = limited(curvatureAround(surface.diagonal, surface.mixed)).toVar("skinCurvature");
    surface.towards = toLight => limited(curvatureTowards(surface.diagonal, surface.mixed, normal, toLight));
  } else {
    const given = material.curvatureAttribute && attribute(material.curvatureAttribute, "float");
    const positionMm = positionView.mul(materialReference("mmPerUnit", "float")), n = normalViewGeometry;
    mean = given || meanCurvatureFromDerivatives(dFdx(positionMm), dFdy(positionMm), dFdx(n), dFdy(n));
    surface.curvature = limited(given ? given.abs() : curvatureFromDerivatives(fwidth(n), fwidth(positionMm))).toVar("skinCurvature");
    surface.diagonal = sphereDiagonal(surface.curvature, normal).toVar();
    surface.mixed = sphereMixed(surface.curvature, normal).toVar();
    surface.towards = () => surface.curvature;
  }
  surface.gain = material.gain ? skinGain(mean.mul(gain)).toVar("skinGain") : vec3(1);
  surface.bands = [skinAmbientBand1(surface.curvature).div(2 / 3 * Math.PI), skinAmbientBand2(surface.curvature).div(Math.PI / 4)]
    .map(band => band.toVar());
  surface.ambientNormals = null;
  if (!material.bakedNormals) return surface;
  const baked = readBaked(material.bakedNormals, own);
  surface.normals = baked.normals;
  const around = mix(surface.curvature, limited(baked.curvature), baked.skin).toVar();
  surface.towards = toLight => around.mul(spreadTowards(baked.normals[0], baked.uneven, toLight).sqrt()).min(maxCurvaturePerMm);
  surface.bands = [baked.lengths, band2OfMeans(baked.lengths).toVar()];
  surface.ambientNormals = baked.normals;
  return surface;
}
