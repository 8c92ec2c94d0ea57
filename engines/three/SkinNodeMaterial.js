// Skin, pre-integrated (Penner 2011): diffuse light over N.L and curvature from skin_table.exr, two specular lobes, transmission
// through thin parts by a map of their thickness, light from all around by its bands of spherical harmonics. Every light of the
// scene, with its shadow, and its environment, in WebGPURenderer on WebGPU and on WebGL 2. Made by dermis @version@ for @profile@.
//
//     const skin = new SkinNodeMaterial({ table: await loadSkinTable(), map: albedo, normalMap: normals });

import { MeshStandardNodeMaterial, PhysicalLightingModel } from "three/webgpu";
import {
  diffuseContribution, float, materialReference, materialRoughness, mix, normalView, normalViewGeometry, positionViewDirection,
  screenCoordinate, specularColor, specularColorBlended, specularF90, texture, vec3,
} from "three/tsl";
import { changeOfEnvironment, changeOfLight, lightOfHarmonics } from "./SkinAmbient.js";
import {
  diffuseCoordinate, fresnelSchlick, ggx, signOfMissingCurvature, signOfMissingTable, skinDiffuse, skinFarShare, thinLight,
  twoLobeGgx,
} from "./SkinFunction.js";
import { gatheredColor } from "./SkinShadow.js";
import { readSurface } from "./SkinSurface.js";
import { faultOfTable, maxCurvaturePerMm } from "./SkinTable.js";
import { colorBehind, thicknessMm } from "./SkinThickness.js";

export * from "./SkinFunction.js";
export * from "./SkinTable.js";

const gainOfSlabs = /*@__PURE__*/ vec3(@gain_of_slabs@);

// Reflections of the environment stay those of MeshStandardNodeMaterial (GGX).
class SkinLightingModel extends PhysicalLightingModel {
  constructor(material) {
    super();
    this.material = material;
  }

  start(builder) {
    this.surface = readSurface(this.material, builder.geometry);
    this.thickness = thicknessMm(this.material)?.toVar("skinThickness");
    this.farShare = this.thickness && skinFarShare(this.thickness).toVar("skinFarShare");
    super.start(builder);
  }

  direct({ lightDirection, lightColor, lightNode, reflectedLight }, builder) {
    const nDotL = normalView.dot(lightDirection).toVar();
    reflectedLight.directDiffuse.addAssign(this.diffuse(nDotL, lightDirection, lightColor, lightNode, builder)
      .mul(diffuseContribution).div(Math.PI));

    const h = lightDirection.add(positionViewDirection).normalize();
    const roughness = this.material.roughnessNode ?? materialRoughness;
    const cosines = [normalView.dot(h).clamp(), nDotL.max(1e-4), normalView.dot(positionViewDirection).max(1e-3)];
    const perceptual = float(roughness).clamp(0.03, 1);
    const lobes = this.material.twoLobes ? twoLobeGgx(...cosines, perceptual) : ggx(...cosines, perceptual.mul(perceptual));
    const fresnel = fresnelSchlick(specularColor.r, positionViewDirection.dot(h).clamp());
    reflectedLight.directSpecular.addAssign(lightColor.mul(nDotL.greaterThan(0).select(lobes.mul(fresnel), 0)));
  }

  // Light of one direction that leaves, before the albedo.
  diffuse(nDotL, lightDirection, lightColor, lightNode, builder) {
    const { material, surface } = this, toLight = surface.toMesh(lightDirection).toVar();
    const hasOwnShadow = material.penumbraMm > 0 || (material.scattering && material.scatteredShadow);
    const arriving = hasOwnShadow ? gatheredColor(lightNode, lightColor, material, { ...surface, toLight }, builder) : lightColor;
    if (!material.scattering) return arriving.mul(nDotL.max(0));
    const entered = arriving.mul(material.setupDiffuse(surface, nDotL, toLight));
    if (!this.farShare) return entered.mul(surface.gain);
    const farCosine = normalViewGeometry.dot(lightDirection).negate().max(0);
    const behind = colorBehind(lightNode, lightDirection, lightColor, this.thickness, builder).mul(farCosine);
    return thinLight(entered, behind, this.farShare, surface.gain, material.gain ? gainOfSlabs : vec3(1));
  }

  // Diffuse light is not lessened by what is reflected: the table has all of it.
  indirect(builder) {
    const { context } = builder, { irradiance, iblIrradiance, radiance, reflectedLight } = context, { material, surface } = this;
    if (material.scattering)
      for (const lightNode of builder.lightsNode.getLightNodes(builder)) {
        const change = changeOfLight(lightNode, surface);
        if (change) irradiance.addAssign(change);
      }
    const arriving = irradiance.add(iblIrradiance).max(0);
    const ofMap = float(context.ambientOcclusion).toVar();
    const plain = (surface.plainOcclusion ?? float(1)).min(ofMap).toVar();
    const occlusion = !material.scattering ? plain : (surface.occlusion?.min(ofMap) ?? plain).mul(surface.gain);
    reflectedLight.indirectDiffuse.addAssign(arriving.mul(occlusion).mul(diffuseContribution).div(Math.PI));
    // As Lagarde and de Rousiers 2014.
    const nDotV = normalView.dot(positionViewDirection).clamp();
    const open = nDotV.add(plain).pow(materialRoughness.mul(-16).sub(1).exp2()).sub(1).add(plain).clamp();
    reflectedLight.indirectSpecular.addAssign(radiance.mul(this.singleScatteringDielectric).mul(open));
  }
}

export class SkinNodeMaterial extends MeshStandardNodeMaterial {
  static get type() { return "SkinNodeMaterial"; }

  constructor(parameters) {
    super();
    this.isSkinNodeMaterial = true;
    this.table = null;               // of loadSkinTable()
    this.closedForm = false;         // true: no table is read, about 90 multiply-adds a light instead
    this.environmentHarmonics = null;  // nine colours as Vector3: what diffuse light takes instead of filtered scene.environment
    this.bakedNormals = null;        // { red, green, spread }: textures of a head, over its second texture coordinates
    this.scatteredShadow = true;     // 16 reads of a shadow map, 64 at an edge, instead of a hard edge
    this.penumbraMm = 0;             // width of a shadow's edge: 24 reads of the map more; 0: the renderer's own filter
    this.scattering = true;          // false: Lambert's skin, for comparison
    this.gain = true;                // false: the profile alone; curved skin returns no more than flat skin
    this.specularMap = null;         // factor on f0, alpha
    this.curvatureAttribute = null;  // name of a vertex attribute, a float in 1/mm; null: from derivatives
    this.thicknessMap = null;        // transmission through thin parts: green is their thickness, linear; null: none goes through
    this.thicknessMaxMm = 20;        // thickness in mm of a map value of 1
    this.thicknessNode = null;       // in place of the map: a node of the thickness in mm
    this.mmPerUnit = 1000;           // millimetres in a unit of the scene: 1000 where units are metres
    this.twoLobes = true;            // false: one lobe, GGX
    this.curvatureGain = 1;          // factor on the curvature, 0 to 4: 1 is the skin as measured
    this.f0 = 0.028;                 // reflectance at normal incidence, 0 to 0.08
    this.roughness = 0.45;           // perceptual, 0.03 to 1
    this.setValues(parameters);
  }

  copy(source) {
    const own = ["table", "closedForm", "curvatureAttribute", "thicknessMap", "thicknessMaxMm", "thicknessNode", "mmPerUnit",
      "curvatureGain", "f0", "environmentHarmonics", "bakedNormals", "scatteredShadow", "penumbraMm", "scattering", "gain", "specularMap", "twoLobes"];
    for (const name of own) this[name] = source[name];
    return super.copy(source);
  }

  // What decides about the shader's text: another table or attribute builds it anew.
  customProgramCacheKey() {
    const table = this.closedForm ? "none" : this.table?.uuid ?? "missing";
    const maps = [this.thicknessMap, this.bakedNormals?.red, this.specularMap].map(map => map?.uuid).join(" ");
    const harmonics = this.environmentHarmonics?.map(({ x, y, z }) => [x, y, z]).join();
    const choices = [harmonics, this.curvatureAttribute, this.scatteredShadow, this.penumbraMm > 0, this.scattering, this.gain, this.twoLobes].join(" ");
    return `${super.customProgramCacheKey()} ${table} ${faultOfTable(this.table)} ${choices} ${maps}`;
  }

  setupEnvironment(builder) {
    const environment = super.setupEnvironment(builder);
    if (!environment) return null;
    const setup = environment.setup;

    environment.setup = inner => {
      setup.call(environment, inner);
      const { context: { iblIrradiance, lightingModel: { material, surface } } } = inner;
      if (material.environmentHarmonics)
        iblIrradiance.assign(lightOfHarmonics(material.environmentHarmonics, material.scattering ? surface : null));
      else if (material.scattering) iblIrradiance.addAssign(changeOfEnvironment(environment, surface));
    };
    return environment;
  }

  setupLightingModel() { return new SkinLightingModel(this); }

  setupSpecular() {
    const factor = this.specularMap ? texture(this.specularMap).a : float(1);
    const f0 = vec3(materialReference("f0", "float").mul(factor));
    specularColor.assign(f0);
    specularColorBlended.assign(f0);
    specularF90.assign(1);
  }

  // In place of max(N.L, 0).
  setupDiffuse({ normals, towards }, nDotL, toLight) {
    const curvature = towards(toLight).toVar();
    if (!normals) return this.setupFalloff(nDotL, curvature);
    const [red, green, blue] = normals.map(normal => this.setupFalloff(normal.dot(toLight), curvature));
    return vec3(red.x, green.y, blue.z);
  }

  setupFalloff(nDotL, curvature) {
    if (this.closedForm) return skinDiffuse(nDotL.clamp(-1, 1), curvature);
    return texture(this.table, diffuseCoordinate(nDotL, curvature, maxCurvaturePerMm)).level(0).rgb;
  }

  // What is missing is written over the surface, and said once on the console.
  setupLighting(builder) {
    const hasCurvature = this.curvatureAttribute
      ? builder.geometry.hasAttribute(this.curvatureAttribute)
      : builder.geometry.hasAttribute("normal") && !this.flatShading;
    const fault = this.closedForm ? "" : faultOfTable(this.table);
    if (!fault && hasCurvature) return super.setupLighting(builder);
    console.warn(fault ? `SkinNodeMaterial.table: ${fault}. Set it to what loadSkinTable() gives.`
      : this.curvatureAttribute ? `SkinNodeMaterial.curvatureAttribute: the geometry has no attribute "${this.curvatureAttribute}".`
        : "SkinNodeMaterial: curvature from derivatives needs smooth normals; this geometry has none.");
    const sign = fault ? signOfMissingTable(screenCoordinate) : signOfMissingCurvature(screenCoordinate);
    return mix(vec3(0.02), vec3(1), sign);
  }
}
