// The subsurface scattering of Babylon.js for a skin: @profile@.
//
//     import { applySkinProfile } from "./skin_profile.js";
//     applySkinProfile(material);        // a PBRMaterial; a scene unit is a metre
//     applySkinProfile(material, 0.01);  // a scene unit is a centimetre

import { Color3 } from "@babylonjs/core/Maths/math.color.js";
import "@babylonjs/core/Engines/WebGPU/Extensions/engine.multiRender.js";
import "@babylonjs/core/Rendering/prePassRendererSceneComponent.js";
import "@babylonjs/core/Rendering/subSurfaceSceneComponent.js";

// Burley's d in mm is 2 / (color * metersPerUnit) where a unit is a metre: @d_mm_r@, @d_mm_g@, @d_mm_b@.
export const color = [@color_r@, @color_g@, @color_b@], metersPerUnit = @metersperunit@;

// All scattering materials of a scene share its metersPerUnit.
export function applySkinProfile(material, metresInUnit = 1) {
  const scattering = material.getScene().enableSubSurfaceForPrePass();
  if (!scattering) throw new Error("Subsurface scattering needs multiple render targets, which this device has not.");
  scattering.metersPerUnit = metersPerUnit * metresInUnit;
  const { subSurface } = material, profile = Color3.FromArray(color);
  subSurface.scatteringDiffusionProfile = profile;
  if (!subSurface.scatteringDiffusionProfile.equals(profile))
    throw new Error("The scene has no room for another diffusion profile: call scene.subSurfaceConfiguration.clearAllDiffusionProfiles() before.");
  subSurface.isScatteringEnabled = true;
}
