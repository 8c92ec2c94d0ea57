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
import { frameAttribute, headAttributes, shadowUniforms } from "./SkinSurfaceCode.js";
import { faultOfTable } from "./SkinTable.js";

export * from "./SkinTable.js";

// In 1/mm, a float a vertex: read with `curvatureFromVertices`.
export const curvatureAttribute = "curvature_per_mm";

// What decides about the shader's text.
const kChoices = {
  table: null,                   // of loadSkinTable()
  closedForm: false,             // true: no table is read, about 90 multiply-adds a light instead
  curvatureFromVertices: false,  // true: the curvature is the attribute curvature_per_mm; false: from derivatives, which see the facets
  // Transmission through thin parts: green is their thickness, linear (gammaSpace false), in the first texture coordinates, of a head
  // in those of the skin's atlas; null: none goes through.
  thicknessTexture: null,
  bakedNormals: null,            // { red, green, spread }: textures of a head, linear, over the skin's atlas
  specularTexture: null,         // factor on f0, alpha
  penumbraMm: 0,                 // width of a shadow's edge, with scattering around it, 40 to 88 reads; 0: Babylon's own filter. Needs PCF
  scattering: true,              // false: Lambert's skin, for comparison
  gain: true,                    // false: the profile alone; curved skin returns no more than flat skin
  twoLobes: true,                // false: one lobe, GGX
};

const kSamplers = {
  skinTable: skin => skin.table,
  skinThickness: skin => skin.thicknessTexture,
  skinRed: skin => skin.bakedNormals?.red,
  skinGreen: skin => skin.bakedNormals?.green,
  skinSpread: skin => skin.bakedNormals?.spread,
  skinSpecular: skin => skin.specularTexture,
};

export class SkinMaterialPlugin extends MaterialPluginBase {
  constructor(material) {
    super(material, "DermisSkin", 200, {
      SKIN_TABLE: false, SKIN_VERTEX_CURVATURE: false, SKIN_NO_TABLE: false, SKIN_NO_CURVATURE: false, SKIN_HEAD: false, SKIN_MOVES: false,
      SKIN_BAKED: false,
      SKIN_ENVIRONMENT: false, SKIN_REFLECTION: false, SKIN_CHANGED_ENGINE: false, SKIN_THICKNESS: false, SKIN_SPECULAR: false,
      SKIN_DISK: false, SKIN_SCATTERING: true, SKIN_GAIN: true, SKIN_ONE_LOBE: false,
    });
    this._choices = { ...kChoices };
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
        this._engineFault = fault;
        this.markAllDefinesAsDirty();
      });
  }

  getClassName() { return "SkinMaterialPlugin"; }
  isCompatible(language) { return language === ShaderLanguage.GLSL || language === ShaderLanguage.WGSL; }

  prepareDefinesBeforeAttributes(defines) {
    if (this.thicknessTexture || this.specularTexture) defines._needUVs = defines.MAINUV1 = true;
  }

  prepareDefines(defines, scene, mesh) {
    const fault = this.closedForm ? "" : faultOfTable(this.table);
    const attribute = this.curvatureFromVertices ? curvatureAttribute : "normal";
    const hasCurvature = mesh.isVerticesDataPresent(attribute), isHead = this._isHead(mesh);
    defines.SKIN_TABLE = !this.closedForm && fault === "";
    defines.SKIN_THICKNESS = Boolean(this.thicknessTexture);
    defines.SKIN_SPECULAR = Boolean(this.specularTexture);
    defines.SKIN_HEAD = isHead;
    defines.SKIN_MOVES = isHead && mesh.isVerticesDataPresent(frameAttribute);
    defines.SKIN_BAKED = Boolean(isHead && this.bakedNormals);
    defines.SKIN_DISK = this.penumbraMm > 0;
    defines.SKIN_SCATTERING = this.scattering;
    defines.SKIN_GAIN = this.gain;
    defines.SKIN_ONE_LOBE = !this.twoLobes;
    defines.SKIN_VERTEX_CURVATURE = !isHead && this.curvatureFromVertices && hasCurvature;
    // An irradiance texture in place of the harmonics stays Lambert's.
    defines.SKIN_ENVIRONMENT = Boolean(defines.USESPHERICALFROMREFLECTIONMAP && !defines.REALTIME_FILTERING);
    defines.SKIN_REFLECTION = Boolean(defines.REFLECTION && defines.ENVIRONMENTBRDF);
    defines.SKIN_CHANGED_ENGINE = Boolean(this._engineFault);
    defines.SKIN_NO_TABLE = fault !== "";
    defines.SKIN_NO_CURVATURE = fault === "" && !hasCurvature;
    this._say(fault ? `table: ${fault}. Set it to what loadSkinTable() gives.`
      : !hasCurvature ? `no curvature, as the mesh ${mesh.name} has no attribute "${attribute}".`
        : defines.SKIN_BAKED && Object.values(this.bakedNormals).some(map => map.gammaSpace)
          ? "bakedNormals: gammaSpace of the maps has to be false: they hold directions, not colours." : "");
  }

  // What is wrong is said once on the console; what is missing is written over the surface too.
  _say(fault) {
    if (fault && fault !== this._said) console.warn(`SkinMaterialPlugin: ${fault}`);
    this._said = fault;
  }

  _isHead(mesh) { return Object.keys(headAttributes).every(name => mesh.isVerticesDataPresent(name)); }
  get _textures() { return Object.values(kSamplers).map(textureOf => textureOf(this)).filter(texture => texture); }

  getAttributes(attributes, scene, mesh) {
    if (this._isHead(mesh)) {
      attributes.push(...Object.keys(headAttributes));
      if (mesh.isVerticesDataPresent(frameAttribute)) attributes.push(frameAttribute, ...attributes.includes("tangent") ? [] : ["tangent"]);
    } else if (this.curvatureFromVertices) attributes.push(curvatureAttribute);
  }
  getSamplers(samplers) { samplers.push(...Object.keys(kSamplers)); }
  getActiveTextures(textures) { textures.push(...this._textures); }
  hasTexture(texture) { return this._textures.includes(texture); }
  isReadyForSubMesh() { return this._engineFault !== null && this._textures.every(texture => texture.isReady()); }

  getUniforms(language) {
    const ubo = ["skinSettings", "skinShadowSettings"].map(name => ({ name, size: 4, type: "vec4" }));
    for (const [name, numbers] of Object.entries(shadowUniforms)) ubo.push({ name, size: 4, type: "vec4", arraySize: numbers.length / 4 });
    if (language === ShaderLanguage.WGSL) return { ubo };
    const declared = ubo.map(({ name, arraySize }) => `uniform vec4 ${name}${arraySize ? `[${arraySize}]` : ""};`);
    return { ubo, fragment: declared.join(" ") };
  }

  bindForSubMesh(uniforms, scene, engine) {
    const { width = 0, height = 0 } = this.bakedNormals?.red.getSize() ?? {};
    uniforms.updateFloat4("skinSettings", this.mmPerUnit, this.curvatureGain, this.f0, engine.getRenderHeight());
    uniforms.updateFloat4("skinShadowSettings", 0.5 * this.penumbraMm, this.thicknessMaxMm, width, height);
    for (const [name, numbers] of Object.entries(shadowUniforms)) uniforms.updateArray(name, numbers);
    for (const [name, textureOf] of Object.entries(kSamplers)) {
      const texture = textureOf(this);
      if (texture) uniforms.setTexture(name, texture);
    }
  }

  getCustomCode(shaderType, language) {
    return (language === ShaderLanguage.WGSL ? wgslCode : glslCode)[shaderType] ?? null;
  }
}

for (const name of Object.keys(kChoices))
  Object.defineProperty(SkinMaterialPlugin.prototype, name, {
    get() { return this._choices[name]; },
    set(value) {
      this._choices[name] = value;
      this.markAllDefinesAsDirty();
    },
  });
