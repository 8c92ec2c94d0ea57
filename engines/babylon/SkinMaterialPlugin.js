// Skin, pre-integrated (Penner 2011): diffuse light over N.L and curvature from skin_table.dds, two specular lobes, transmission
// through thin parts by a map of their thickness, light from all around by its bands of spherical harmonics. Every light of the
// scene, with its shadow, and its environment, on a PBRMaterial, in WebGL 2 and WebGPU. Made by dermis @version@ for @profile@.
//
//     const material = new PBRMaterial("skin", scene);
//     const skin = new SkinMaterialPlugin(material);
//     skin.table = await loadSkinTable(scene);

import { MaterialPluginBase } from "@babylonjs/core/Materials/materialPluginBase.js";
import { ShaderLanguage } from "@babylonjs/core/Materials/shaderLanguage.js";
import { glslCode, wgslCode } from "./SkinCode.js";
import { faultOfEngine } from "./SkinEngineText.js";
import { faultOfTable } from "./SkinTable.js";

export * from "./SkinTable.js";

// In 1/mm, a float a vertex: read with `curvatureFromVertices`.
export const curvatureAttribute = "curvature_per_mm";

export class SkinMaterialPlugin extends MaterialPluginBase {
  constructor(material) {
    super(material, "DermisSkin", 200, {
      SKIN_TABLE: false, SKIN_VERTEX_CURVATURE: false, SKIN_NO_TABLE: false, SKIN_NO_CURVATURE: false,
      SKIN_ENVIRONMENT: false, SKIN_REFLECTION: false, SKIN_CHANGED_ENGINE: false, SKIN_THICKNESS: false,
    });
    this._table = null;
    this._closedForm = false;
    this._curvatureFromVertices = false;
    this._thicknessTexture = null;
    this._said = "";
    this._engineFault = null;  // null: not looked at yet
    this.thicknessMaxMm = 20;  // thickness in mm of a map value of 1
    this.mmPerUnit = 1000;   // millimetres in a unit of the scene: 1000 where units are metres
    this.curvatureGain = 1;  // factor on the curvature, 0 to 4: 1 is the skin as measured
    this.f0 = 0.028;         // reflectance at normal incidence, 0 to 0.08
    // Skin is no metal, and the table has all of the diffuse light: nothing is taken from it for the reflection.
    material.metallic = 0;
    material.roughness = 0.45;
    material.brdf.useLegacySpecularEnergyConservation = true;
    material.brdf.useEnergyConservation = false;
    material.metallicF0Factor = 0;
    material.forceIrradianceInFragment = true;
    this._enable(true);
    const { shaderLanguage } = material;
    faultOfEngine(shaderLanguage === ShaderLanguage.WGSL ? wgslCode : glslCode, shaderLanguage)
      .catch(error => `the engine's shader cannot be read: ${error.message}`)
      .then(fault => {
        if (fault) console.warn(`SkinMaterialPlugin: ${fault}`);
        this._change("_engineFault", fault);
      });
  }

  // Of loadSkinTable().
  get table() { return this._table; }
  set table(table) { this._change("_table", table); }
  // true: no table is read, about 90 multiply-adds a light instead.
  get closedForm() { return this._closedForm; }
  set closedForm(on) { this._change("_closedForm", on); }
  // true: the curvature is the attribute curvature_per_mm of the mesh; false: from derivatives, which see its facets.
  get curvatureFromVertices() { return this._curvatureFromVertices; }
  set curvatureFromVertices(on) { this._change("_curvatureFromVertices", on); }
  // Transmission through thin parts: green is their thickness, linear (gammaSpace false), in the first texture coordinates; null: none
  // goes through.
  get thicknessTexture() { return this._thicknessTexture; }
  set thicknessTexture(texture) { this._change("_thicknessTexture", texture); }

  _change(name, value) {
    this[name] = value;
    this.markAllDefinesAsDirty();
  }

  getClassName() { return "SkinMaterialPlugin"; }
  isCompatible(language) { return language === ShaderLanguage.GLSL || language === ShaderLanguage.WGSL; }

  prepareDefinesBeforeAttributes(defines) {
    if (this._thicknessTexture) defines._needUVs = defines.MAINUV1 = true;
  }

  // What is missing is written over the surface, and said once on the console.
  prepareDefines(defines, scene, mesh) {
    const fault = this._closedForm ? "" : faultOfTable(this._table);
    const attribute = this._curvatureFromVertices ? curvatureAttribute : "normal";
    const hasCurvature = mesh.isVerticesDataPresent(attribute);
    defines.SKIN_TABLE = !this._closedForm && fault === "";
    defines.SKIN_THICKNESS = Boolean(this._thicknessTexture);
    defines.SKIN_VERTEX_CURVATURE = this._curvatureFromVertices && hasCurvature;
    // An irradiance texture in place of the harmonics stays Lambert's.
    defines.SKIN_ENVIRONMENT = Boolean(defines.USESPHERICALFROMREFLECTIONMAP && !defines.REALTIME_FILTERING);
    defines.SKIN_REFLECTION = Boolean(defines.REFLECTION && defines.ENVIRONMENTBRDF);
    defines.SKIN_CHANGED_ENGINE = Boolean(this._engineFault);
    defines.SKIN_NO_TABLE = fault !== "";
    defines.SKIN_NO_CURVATURE = fault === "" && !hasCurvature;
    const said = fault ? `SkinMaterialPlugin.table: ${fault}. Set it to what loadSkinTable() gives.`
      : hasCurvature ? "" : `SkinMaterialPlugin: no curvature, as the mesh ${mesh.name} has no attribute "${attribute}".`;
    if (said && said !== this._said) console.warn(said);
    this._said = said;
  }

  getAttributes(attributes) {
    if (this._curvatureFromVertices) attributes.push(curvatureAttribute);
  }
  getSamplers(samplers) { samplers.push("skinTable", "skinThickness"); }
  get _textures() { return [this._table, this._thicknessTexture].filter(texture => texture); }
  getActiveTextures(textures) { textures.push(...this._textures); }
  hasTexture(texture) { return this._textures.includes(texture); }
  isReadyForSubMesh() { return this._engineFault !== null && this._textures.every(texture => texture.isReady()); }

  getUniforms(language) {
    const ubo = [{ name: "skinSettings", size: 4, type: "vec4" }, { name: "skinThicknessMaxMm", size: 1, type: "float" }];
    return language === ShaderLanguage.WGSL ? { ubo } : { ubo, fragment: "uniform vec4 skinSettings; uniform float skinThicknessMaxMm;" };
  }

  bindForSubMesh(uniforms, scene, engine) {
    uniforms.updateFloat4("skinSettings", this.mmPerUnit, this.curvatureGain, this.f0, engine.getRenderHeight());
    uniforms.updateFloat("skinThicknessMaxMm", this.thicknessMaxMm);
    if (this._table) uniforms.setTexture("skinTable", this._table);
    if (this._thicknessTexture) uniforms.setTexture("skinThickness", this._thicknessTexture);
  }

  getCustomCode(shaderType, language) {
    return (language === ShaderLanguage.WGSL ? wgslCode : glslCode)[shaderType] ?? null;
  }
}
