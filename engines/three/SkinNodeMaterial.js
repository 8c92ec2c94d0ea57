// Skin, pre-integrated (Penner 2011): diffuse light over N.L and curvature from skin_table.exr, two specular lobes, transmission
// through thin parts by a map of their thickness, light from all around by its bands of spherical harmonics. Every light of the
// scene, with its shadow, and its environment, in WebGPURenderer on WebGPU and on WebGL 2. Made by dermis @version@ for @profile@.
//
//     const skin = new SkinNodeMaterial({ table: await loadSkinTable(), map: albedo, normalMap: normals });

import { MeshStandardNodeMaterial, PhysicalLightingModel } from "three/webgpu";
import {
  attribute, diffuseContribution, float, fwidth, materialReference, materialRoughness, mix, normalView, normalViewGeometry,
  positionView, positionViewDirection, screenCoordinate, specularColor, specularColorBlended, specularF90, texture, vec3,
} from "three/tsl";
import { changeOfEnvironment, changeOfLight } from "./SkinAmbient.js";
import {
  curvatureFromDerivatives, diffuseCoordinate, fresnelSchlick, signOfMissingCurvature, signOfMissingTable, skinAmbientBand1,
  skinAmbientBand2, skinDiffuse, skinFarShare, twoLobeGgx,
} from "./SkinFunction.js";
import { faultOfTable, maxCurvaturePerMm } from "./SkinTable.js";
import { colorBehind, thicknessMm } from "./SkinThickness.js";

export * from "./SkinFunction.js";
export * from "./SkinTable.js";

// Reflections of the environment stay those of MeshStandardNodeMaterial (GGX).
class SkinLightingModel extends PhysicalLightingModel {
  constructor(material) {
    super();
    this.material = material;
  }

  start(builder) {
    this.curvature = this.material.setupCurvature(builder).toVar("skinCurvature");
    this.bands = [skinAmbientBand1(this.curvature).div(2 / 3 * Math.PI), skinAmbientBand2(this.curvature).div(Math.PI / 4)]
      .map(band => band.toVar());
    this.thickness = thicknessMm(this.material)?.toVar("skinThickness");
    this.farShare = this.thickness && skinFarShare(this.thickness).toVar("skinFarShare");
    super.start(builder);
  }

  direct({ lightDirection, lightColor, lightNode, reflectedLight }, builder) {
    const nDotL = normalView.dot(lightDirection).toVar();
    let entered = lightColor.mul(this.material.setupDiffuse(nDotL, this.curvature));
    if (this.farShare) {
      const farCosine = normalViewGeometry.dot(lightDirection).negate().max(0);
      const behind = colorBehind(lightNode, lightDirection, lightColor, this.thickness, builder).mul(farCosine);
      entered = mix(entered, behind, this.farShare);
    }
    reflectedLight.directDiffuse.addAssign(entered.mul(diffuseContribution).div(Math.PI));

    const h = lightDirection.add(positionViewDirection).normalize();
    const roughness = this.material.roughnessNode ?? materialRoughness;
    const lobes = twoLobeGgx(normalView.dot(h).clamp(), nDotL.max(1e-4), normalView.dot(positionViewDirection).max(1e-3),
      float(roughness).clamp(0.03, 1));
    const fresnel = fresnelSchlick(specularColor.r, positionViewDirection.dot(h).clamp());
    reflectedLight.directSpecular.addAssign(lightColor.mul(nDotL.greaterThan(0).select(lobes.mul(fresnel), 0)));
  }

  // Diffuse light is not lessened by what is reflected: the table has all of it.
  indirect(builder) {
    const { irradiance, iblIrradiance, radiance, reflectedLight } = builder.context;
    for (const lightNode of builder.lightsNode.getLightNodes(builder)) {
      const change = changeOfLight(lightNode, this.bands);
      if (change) irradiance.addAssign(change);
    }
    const arriving = irradiance.add(iblIrradiance).max(0);
    reflectedLight.indirectDiffuse.addAssign(arriving.mul(diffuseContribution).div(Math.PI));
    reflectedLight.indirectSpecular.addAssign(radiance.mul(this.singleScatteringDielectric));
    this.ambientOcclusion(builder);
  }
}

export class SkinNodeMaterial extends MeshStandardNodeMaterial {
  static get type() { return "SkinNodeMaterial"; }

  constructor(parameters) {
    super();
    this.isSkinNodeMaterial = true;
    this.table = null;               // of loadSkinTable()
    this.closedForm = false;         // true: no table is read, about 90 multiply-adds a light instead
    this.curvatureAttribute = null;  // name of a vertex attribute, a float in 1/mm; null: from derivatives
    this.thicknessMap = null;        // transmission through thin parts: green is their thickness, linear; null: none goes through
    this.thicknessMaxMm = 20;        // thickness in mm of a map value of 1
    this.thicknessNode = null;       // in place of the map: a node of the thickness in mm
    this.mmPerUnit = 1000;           // millimetres in a unit of the scene: 1000 where units are metres
    this.curvatureGain = 1;          // factor on the curvature, 0 to 4: 1 is the skin as measured
    this.f0 = 0.028;                 // reflectance at normal incidence, 0 to 0.08
    this.roughness = 0.45;           // perceptual, 0.03 to 1
    this.setValues(parameters);
  }

  copy(source) {
    const own = ["table", "closedForm", "curvatureAttribute", "thicknessMap", "thicknessMaxMm", "thicknessNode", "mmPerUnit",
      "curvatureGain", "f0"];
    for (const name of own) this[name] = source[name];
    return super.copy(source);
  }

  // What decides about the shader's text: another table or attribute builds it anew.
  customProgramCacheKey() {
    const table = this.closedForm ? "none" : this.table?.uuid ?? "missing";
    return `${super.customProgramCacheKey()} ${table} ${faultOfTable(this.table)} ${this.curvatureAttribute} ${this.thicknessMap?.uuid}`;
  }

  setupEnvironment(builder) {
    const environment = super.setupEnvironment(builder);
    if (!environment) return null;
    const setup = environment.setup;

    environment.setup = inner => {
      setup.call(environment, inner);
      inner.context.iblIrradiance.addAssign(changeOfEnvironment(environment, inner.context.lightingModel.bands));
    };
    return environment;
  }

  setupLightingModel() { return new SkinLightingModel(this); }

  setupSpecular() {
    const f0 = vec3(materialReference("f0", "float"));
    specularColor.assign(f0);
    specularColorBlended.assign(f0);
    specularF90.assign(1);
  }

  // In 1/mm, of the mesh: a bump of the map is smaller than what scatters.
  setupCurvature() {
    const measured = this.curvatureAttribute
      ? attribute(this.curvatureAttribute, "float").abs()
      : curvatureFromDerivatives(fwidth(normalViewGeometry), fwidth(positionView.mul(materialReference("mmPerUnit", "float"))));
    return measured.mul(materialReference("curvatureGain", "float")).min(maxCurvaturePerMm);
  }

  setupDiffuse(nDotL, curvature) {
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
