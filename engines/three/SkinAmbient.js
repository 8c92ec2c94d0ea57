// Light from all around on skin: what scattering changes in an irradiance E(n) that three.js has computed for Lambert. E has three
// bands of spherical harmonics (Ramamoorthi, Hanrahan 2001). The even ones are in (E(n) + E(-n)) / 2, the odd one is (E(n) - E(-n)) / 2;
// skin multiplies those of order 1 and 2 by factors,
// which depend on its curvature.

import { REVISION } from "three/webgpu";
import { float, getShIrradianceAt, isolate, materialEnvIntensity, materialEnvRotation, normalWorld, uniformArray, vec3, vec4 } from "three/tsl";

const away = /*@__PURE__*/ normalWorld.negate();
const kMeanOverFirst = 0.886227;  // of an irradiance, over the first coefficient of its radiance

// irradiance: E(n), E(-n) and the mean of E over all directions. bands: the factors.
const change = (towardsN, awayFromN, mean, [band1, band2]) => {
  const odd = towardsN.sub(awayFromN).mul(0.5), even = towardsN.add(awayFromN).mul(0.5).sub(mean);
  return odd.mul(band1.sub(1)).add(even.mul(band2.sub(1)));
};

// With baked normals each channel has a direction of its own. irradiance: of a direction in the mesh's space.
function changeOfNormals(irradiance, here, mean, { ambientNormals, bands: [band1, band2] }) {
  const channels = ambientNormals.slice(0, 2).map(normal => {
    const towards = irradiance(normal).toVar(), opposite = irradiance(normal.negate()).toVar();
    const odd = towards.sub(opposite).mul(0.5), even = towards.add(opposite).mul(0.5).sub(mean);
    return mean.add(odd.mul(band1)).add(even.mul(band2)).toVar();
  });
  // Blue takes green's direction, which is nearly its own.
  return vec3(channels[0].x, channels[1].yz).sub(here);
}

// Of a light of the scene, null for one that skin does not change: light of one direction, AmbientLight, which has one band.
export function changeOfLight(lightNode, surface) {
  const { bands, ambientNormals, toWorld } = surface;
  if (lightNode.light?.isLightProbe) {
    const harmonics = lightNode.lightProbe, mean = harmonics.element(0).mul(kMeanOverFirst);
    if (ambientNormals)
      return changeOfNormals(direction => getShIrradianceAt(toWorld(direction), harmonics), getShIrradianceAt(normalWorld, harmonics), mean, surface);
    return change(getShIrradianceAt(normalWorld, harmonics), getShIrradianceAt(away, harmonics), mean, bands);
  }
  if (lightNode.light?.isHemisphereLight) {
    const { colorNode: sky, groundColorNode: ground, lightDirectionNode: up } = lightNode;
    const half = sky.sub(ground).mul(0.5), here = half.mul(normalWorld.dot(up));
    if (!ambientNormals) return here.mul(bands[0].sub(1));
    return half.mul(vec3(...ambientNormals.map(normal => toWorld(normal).dot(up)))).mul(bands[0]).sub(here);
  }
  return null;
}

// The environment's irradiance by nine coefficients of its radiance, in the axes of a panorama whose middle is -Z; surface: null for Lambert.
// EnvironmentNode's own irradiance is filtered as a rough reflection: its second band is stronger than that of a cosine.
export function lightOfHarmonics(coefficients, surface) {
  const harmonics = uniformArray(coefficients, "vec3");
  const irradiance = direction => {
    const turned = materialEnvRotation.mul(vec4(direction, 0)).xyz.toVar();
    return getShIrradianceAt(vec3(turned.z, turned.y, turned.x.negate()), harmonics).mul(materialEnvIntensity);
  };
  const here = irradiance(normalWorld).toVar();
  if (!surface) return here;
  const mean = harmonics.element(0).mul(kMeanOverFirst).mul(materialEnvIntensity);
  if (!surface.ambientNormals) return here.add(change(here, irradiance(away), mean, surface.bands));
  return here.add(changeOfNormals(direction => irradiance(surface.toWorld(direction)), here, mean, surface));
}

// Of EnvironmentNode. Its roughest level is the irradiance over pi; the mean of six directions is that of the sphere for every
// polynomial up to the third degree.
export function changeOfEnvironment(environment, surface) {
  const { envNode } = environment;
  const radiance = envNode.isTextureNode || envNode.isMaterialReferenceNode ? environment._pmremNode : envNode;
  if (!radiance) throw new Error(`SkinNodeMaterial does not find the environment in three.js r${REVISION}: use r187.`);
  const irradiance = direction =>
    isolate(radiance.context({ getUV: () => direction, getTextureLevel: () => float(1) }).mul(materialEnvIntensity).mul(Math.PI));
  const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(axis => vec3(...axis));
  const mean = axes.flatMap(axis => [axis, axis.negate()]).map(irradiance).reduce((sum, one) => sum.add(one)).div(6);
  if (surface.ambientNormals)
    return changeOfNormals(direction => irradiance(surface.toWorld(direction)), irradiance(normalWorld), mean, surface);
  return change(irradiance(normalWorld), irradiance(away), mean, surface.bands);
}
