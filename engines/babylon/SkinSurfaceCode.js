// What the shader knows of the skin at a place, and the functions that follow from it: light of one direction in place of N.L, its
// shadow, light from all around. `l` is a language of SkinLanguage.js. Directions are in the mesh's space, of a head that moves
// in that of its bakes; tensors in 1/mm.
//
// Light from all around: Babylon has computed an irradiance E(n) for Lambert, three bands of spherical harmonics (Ramamoorthi,
// Hanrahan 2001). The even ones are in (E(n) + E(-n)) / 2, the odd one is (E(n) - E(-n)) / 2; skin multiplies those of order 1
// and 2 by factors, which depend on its curvature or its baked normals.

import { diskPlaces, firstPlaces, shadowPlaces } from "./SkinShadowPlaces.js";

// Attributes of a head of `dermis export`: the place on the skin's atlas; three numbers of the curvature tensor and the scattered
// occlusion of red; that of green and blue, and the occlusion as it is.
export const headAttributes = { skin_atlas: 2, skin_bends: 4, skin_occlusion: 3 };

// Of a head that moves: the frame in which it was baked (turned.glsl).
export const frameAttribute = "skin_frame";
// Axes of the world in the space of the bakes, of each vertex; the third one follows.
const axes = ["x", "y"].map(axis => `v_skin_axis_${axis}`);

const kinds = ["vec2", "vec4", "vec3"];
const varyings = Object.keys(headAttributes).map((name, i) => [kinds[i], name, `v_${name}`]);
const [atlas, bends, occlusion] = varyings.map(([, , varying]) => varying);

export const vertexDefinitions = (l, text) => `
#ifdef SKIN_MOVES
${text}
${l.attribute("vec4", frameAttribute)}
#ifndef TANGENT
${l.attribute("vec4", "tangent")}
#endif
${axes.map(axis => l.varying("vec3", axis)).join("\n")}
#endif
#ifdef SKIN_VERTEX_CURVATURE
${l.attribute("float", "curvature_per_mm")}
${l.varying("float", "vSkinCurvature")}
#endif
#ifdef SKIN_HEAD
${varyings.map(([type, name, varying]) => `${l.attribute(type, name)}\n${l.varying(type, varying)}`).join("\n")}
#endif`;

export const vertexEnd = l => `
#ifdef SKIN_VERTEX_CURVATURE
${l.output("vSkinCurvature")} = ${l.given("curvature_per_mm")};
#endif
#ifdef SKIN_HEAD
${varyings.map(([, name, varying]) => `${l.output(varying)} = ${l.given(name)};`).join("\n")}
#endif
#ifdef SKIN_MOVES
{
  ${l.local("vec3", "n")} = normalize((finalWorld * vec4(normalUpdated, 0.0)).xyz);
  ${l.local("vec3", "along")} = (finalWorld * vec4(${l.given("tangent")}.xyz, 0.0)).xyz;
  ${l.local("vec3", "t")} = normalize(along - n * dot(n, along));
  ${l.local("vec3", "b")} = cross(n, t);
  ${axes.map((axis, i) => `${l.output(axis)} = skin_turned(${l.given(frameAttribute)}, vec3(t[${i}], b[${i}], n[${i}]));`).join("\n  ")}
}
#endif`;

export const surfaceDefinitions = l => `
#ifdef SKIN_VERTEX_CURVATURE
${l.varying("float", "vSkinCurvature")}
#endif
#ifdef SKIN_HEAD
${varyings.map(([type, , varying]) => l.varying(type, varying)).join("\n")}
#endif
#ifdef SKIN_MOVES
${axes.map(axis => l.varying("vec3", axis)).join("\n")}
#endif
#ifdef SKIN_TABLE
${l.map("skinTable")}
#endif
#ifdef SKIN_BAKED
${l.map("skinRed")}
${l.map("skinGreen")}
${l.map("skinSpread")}
${l.global("vec3", "skinNormalRed")}
${l.global("vec3", "skinNormalGreen")}
${l.global("vec3", "skinNormalBlue")}
${l.global("vec3", "skinLengths")}
${l.global("vec2", "skinUneven")}
${l.global("float", "skinCurvatureOfMeans")}
#endif
${l.global("float", "skinCurvature")}
${l.global("float", "skinMeanCurvature")}
${l.global("vec3", "skinGain")}
${l.global("vec3", "skinMeshNormal")}
${l.global("vec3", "skinDiagonal")}
${l.global("vec3", "skinMixed")}

#ifdef SKIN_MOVES
${l.method("vec3", "skinToMesh", ["vec3", "direction"])} {
  return normalize(${l.input(axes[0])} * direction.x + ${l.input(axes[1])} * direction.y +
      cross(${l.input(axes[0])}, ${l.input(axes[1])}) * direction.z);
}
${l.method("vec3", "skinToWorld", ["vec3", "direction"])} {
  return normalize(vec3(dot(${l.input(axes[0])}, direction), dot(${l.input(axes[1])}, direction),
      dot(cross(${l.input(axes[0])}, ${l.input(axes[1])}), direction)));
}
#else
${l.method("vec3", "skinToMesh", ["vec3", "direction"])} { return normalize(direction * ${l.rotation}); }
${l.method("vec3", "skinToWorld", ["vec3", "direction"])} { return normalize(${l.rotation} * direction); }
#endif
${l.method("float", "skinLimited", ["float", "curvature"])} {
  return min(curvature * ${l.own("skinSettings")}.y, @max_curvature_per_mm@);
}

${l.method("vec3", "skinFalloff", ["float", "nDotL"], ["float", "curvature"])} {
#ifdef SKIN_TABLE
  return ${l.readLevel("skinTable", "skin_diffuse_coordinate(nDotL, curvature, @max_curvature_per_mm@)", "0.0")}.rgb;
#else
  return skin_diffuse(clamp(nDotL, -1.0, 1.0), curvature);
#endif
}

// In place of max(N.L, 0).
${l.method("vec3", "skinEntered", ["float", "nDotL"], ["vec3", "toLightWorld"])} {
#ifndef SKIN_SCATTERING
  return vec3(max(nDotL, 0.0));
#else
#ifdef SKIN_HEAD
  ${l.local("vec3", "toLight")} = skinToMesh(toLightWorld);
#ifdef SKIN_BAKED
  ${l.local("float", "curvature")} =
    min(skinCurvatureOfMeans * sqrt(skin_spread_towards(skinNormalRed, skinUneven, toLight)), @max_curvature_per_mm@);
  return vec3(skinFalloff(dot(skinNormalRed, toLight), curvature).r, skinFalloff(dot(skinNormalGreen, toLight), curvature).g,
              skinFalloff(dot(skinNormalBlue, toLight), curvature).b);
#else
  return skinFalloff(nDotL, skinLimited(skin_curvature_towards(skinDiagonal, skinMixed, skinMeshNormal, toLight)));
#endif
#else
  return skinFalloff(nDotL, skinCurvature);
#endif
#endif
}`;

// Fills the variables of surfaceDefinitions(). Curvature is of the mesh: a bump of the map is smaller than what scatters.
export const readSurface = l => `
skinMeshNormal = skinToMesh(geometricNormalW);
#ifdef SKIN_HEAD
${l.local("vec3", "skinTangent")} = skin_vertex_tangent(skinMeshNormal);
${l.local("vec3", "skinBitangent")} = cross(skinMeshNormal, skinTangent);
skinDiagonal = skin_tangent_diagonal(${l.input(bends)}.xyz, skinTangent, skinBitangent);
skinMeanCurvature = ${l.input(bends)}.x;
skinMixed = skin_tangent_mixed(${l.input(bends)}.xyz, skinTangent, skinBitangent);
skinCurvature = skinLimited(skin_curvature_around(skinDiagonal, skinMixed));
#else
#ifdef SKIN_VERTEX_CURVATURE
skinMeanCurvature = ${l.input("vSkinCurvature")};
skinCurvature = skinLimited(abs(skinMeanCurvature));
#else
${l.local("vec3", "skinPositionMm")} = ${l.input("vPositionW")} * ${l.own("skinSettings")}.x;
skinCurvature = skinLimited(skin_curvature_from_derivatives(fwidth(geometricNormalW), fwidth(skinPositionMm)));
skinMeanCurvature = skin_mean_curvature_from_derivatives(${l.across("skinPositionMm")}, ${l.down("skinPositionMm")},
    ${l.across("geometricNormalW")}, ${l.down("geometricNormalW")});
#endif
skinDiagonal = skin_sphere_diagonal(skinCurvature, skinMeshNormal);
skinMixed = skin_sphere_mixed(skinCurvature, skinMeshNormal);
#endif
skinGain = skin_gain(skinMeanCurvature * ${l.own("skinSettings")}.y);
#ifdef SKIN_BAKED
${l.local("float", "skinLevel")} = skin_baked_level(${l.across(l.input(atlas))} * ${l.own("skinShadowSettings")}.zw,
    ${l.down(l.input(atlas))} * ${l.own("skinShadowSettings")}.zw);
${l.local("vec3", "skinRedTexel")} = ${l.readLevel("skinRed", l.input(atlas), "skinLevel")}.rgb;
${l.local("vec3", "skinGreenTexel")} = ${l.readLevel("skinGreen", l.input(atlas), "skinLevel")}.rgb;
${l.local("vec3", "skinSpreadTexel")} = ${l.readLevel("skinSpread", l.input(atlas), "skinLevel")}.rgb;
${l.local("vec3", "skinOwnNormal")} = skinToMesh(normalW);
skinNormalRed = skin_mean_normal_red(skinRedTexel, skinSpreadTexel, skinOwnNormal);
skinNormalGreen = skin_mean_normal_green(skinRedTexel, skinGreenTexel, skinSpreadTexel, skinOwnNormal);
skinNormalBlue = skin_mean_normal_blue(skinRedTexel, skinGreenTexel, skinSpreadTexel, skinOwnNormal);
skinLengths = vec3(length(skinNormalRed), length(skinNormalGreen), length(skinNormalBlue));
skinNormalRed = normalize(skinNormalRed);
skinNormalGreen = normalize(skinNormalGreen);
skinNormalBlue = normalize(skinNormalBlue);
${l.local("float", "skinIsBaked")} = skin_baked_skin(skinRedTexel);
skinUneven = (skinSpreadTexel.xy * 2.0 - 1.0) * skinIsBaked;
skinCurvatureOfMeans = mix(skinCurvature, skinLimited(skin_curvature_of_mean(skinLengths.x)), skinIsBaked);
#endif`;

// The places of the gathered shadow as uniforms: along two tangents, off the surface, weight of the penumbra; weights of the channels.
export const shadowUniforms = {
  skinPlaces: shadowPlaces.flatMap(([x, y, lift, , , , penumbra]) => [x, y, lift, penumbra]),
  skinWeights: shadowPlaces.flatMap(([, , , red, green, blue]) => [red, green, blue, 0]),
};

// skinShadow(): the visibility of a light for each channel; skinVisible: for what does not scatter.
export const shadowDefinitions = l => `
#if defined(SKIN_DISK) && defined(SHADOWS)
${l.global("float", "skinVisible")}

// Where a direction of a millimetre leads in the map's clip space.
${l.method("vec4", "skinStep", ["mat4", "toMap"], ["vec3", "directionWorld"])} {
  return toMap * vec4(directionWorld / ${l.own("skinSettings")}.x, 0.0);
}

// Of a directional light; 0 for another one.
${l.method("float", "skinTexelMm", ["mat4", "toMap"], ["float", "mapSide"])} {
  ${l.local("vec3", "row")} = vec3(toMap[0][0], toMap[1][0], toMap[2][0]);
  ${l.local("vec3", "last")} = vec3(toMap[0][3], toMap[1][3], toMap[2][3]);
  return ${l.select("dot(last, last) > 1e-12", "0.0", `2.0 * ${l.own("skinSettings")}.x / (mapSide * length(row))`)};
}

${l.method("vec3", "skinShadow", ["mat4", "toMap"], ["vec2", "depthValues"], ...l.shadowParameter, ["vec4", "info"], ["vec3", "normalWorld"],
    ["vec3", "toLightWorld"])} {
  ${l.local("float", "texelMm")} = skinTexelMm(toMap, info.y);
  ${l.local("vec4", "here")} = toMap * vec4(${l.input("vPositionW")}, 1.0);
  skinVisible = 0.0;
  ${l.count("i", diskPlaces)} {
    ${l.local("vec3", "offset")} = skin_disk_offset_mm(${l.toFloat("i")}, ${diskPlaces}.0, normalWorld, toLightWorld,
        ${l.own("skinShadowSettings")}.x, texelMm);
    ${l.local("vec4", "place")} = here + skinStep(toMap, offset);
    skinVisible += computeShadowWithPCF1(place, skinDepth(place, depthValues), ${l.shadowMap("map")}, info.x, 0.0);
  }
  skinVisible /= ${diskPlaces}.0;
#ifndef SKIN_SCATTERING
  return vec3(skinVisible);
#else
  ${l.local("vec3", "n")} = skinMeshNormal;
  ${l.local("vec3", "toLight")} = skinToMesh(toLightWorld);
  ${l.local("vec3", "across")} = normalize(cross(${l.select("abs(n.y) < 0.9", "vec3(0.0, 1.0, 0.0)", "vec3(1.0, 0.0, 0.0)")}, n));
  ${l.local("vec3", "x")} = skin_gather_tangent(n, toLight, across);
  ${l.local("vec3", "y")} = cross(n, x);
  ${l.local("vec3", "bent")} = skin_gather_bends(skinDiagonal, skinMixed, x, y);
  ${l.local("float", "cosine")} = dot(n, toLight);
  ${l.local("float", "sine")} = length(toLight - n * cosine);
  ${l.local("vec4", "stepX")} = skinStep(toMap, skinToWorld(x));
  ${l.local("vec4", "stepY")} = skinStep(toMap, skinToWorld(y));
  ${l.local("vec4", "stepN")} = skinStep(toMap, normalWorld);
  here += stepN * skin_gather_lift_mm(texelMm);
  ${l.local("vec3", "lit")} = vec3(0.0);
  ${l.local("vec3", "whole")} = vec3(0.0);
  ${l.local("vec2", "red")} = vec2(0.0);  // lit and whole of the places that are trusted
  ${l.local("float", "penumbra")} = 0.0;
  ${l.count("i", shadowPlaces.length)} {
    if (i == ${firstPlaces} && lit.r == skinVisible * whole.r) { return vec3(skinVisible); }
    ${l.local("vec4", "around")} = ${l.own("skinPlaces")}[i];
    ${l.local("vec3", "weight")} = ${l.own("skinWeights")}[i].rgb;
    ${l.local("float", "faces")} = skin_gather_cosine(around.xy, bent, cosine, sine);
    ${l.local("vec4", "place")} = here + stepX * around.x + stepY * around.y + stepN * skin_gather_rise_mm(around.xy, around.z, bent);
    ${l.local("float", "seen")} = computeShadowWithPCF1(place, skinDepth(place, depthValues), ${l.shadowMap("map")}, info.x, 0.0);
    whole += weight * faces;
    lit += weight * (faces * seen);
    red += skin_gather_trust(around.xy, bent) * faces * vec2(seen, 1.0);
    penumbra += around.w * seen;
  }
  ${l.local("vec3", "gathered")} = skin_gathered_light(skinVisible, lit, whole, penumbra, ${shadowPlaces.length}.0);
  ${l.local("vec3", "trusted")} = skin_gathered_trusted_light(skinVisible, gathered, red, penumbra, ${shadowPlaces.length}.0);
#ifdef SKIN_GAIN
  // All diffuse light is multiplied with skinGain later.
  return skin_gathered_with_gain(skinVisible, trusted, gathered, skinGain);
#else
  return trusted;
#endif
#endif
}
#endif`;

export const ambientDefinitions = l => `
// What Lambert's bands are multiplied with.
${l.method("vec3", "skinBand1", ["float", "curvature"])} { return skin_ambient_band_1(curvature) * (1.5 / kSkinPi); }
${l.method("vec3", "skinBand2", ["float", "curvature"])} { return skin_ambient_band_2(curvature) * (4.0 / kSkinPi); }

#ifdef SKIN_ENVIRONMENT
${l.method("vec3", "skinToEnvironment", ["vec3", "directionWorld"])} {
  ${l.local("vec3", "n")} = (${l.own("reflectionMatrix")} * vec4(directionWorld, 0.0)).xyz;
#ifdef REFLECTIONMAP_OPPOSITEZ
  n.z *= -1.0;
#endif
#ifdef INVERTCUBICMAP
  n.y *= -1.0;
#endif
  return n;
}

// The environment's irradiance on scattering skin; n in its space.
${l.method("vec3", "skinEnvironment", ["vec3", "n"], ["vec3", "band1"], ["vec3", "band2"])} {
#ifdef SPHERICAL_HARMONICS
  ${l.local("vec3", "mean")} = ${l.own("vSphericalL00")};
#else
  ${l.local("vec3", "mean")} = ${l.own("vSphericalZZ")} + (${l.own("vSphericalXX_ZZ")} + ${l.own("vSphericalYY_ZZ")}) / 3.0;
#endif
  ${l.local("vec3", "towards")} = computeEnvironmentIrradiance(n);
  ${l.local("vec3", "away")} = computeEnvironmentIrradiance(-n);
  return mean + (towards - away) * 0.5 * band1 + ((towards + away) * 0.5 - mean) * band2;
}
#endif`;

// After Babylon's sum of what comes from all around: finalIrradiance anew, with the occlusion of the vertices.
export const addAmbient = l => `
${l.local("vec3", "skinOcclusion")} = aoOut.ambientOcclusionColor;
${l.local("vec3", "skinPlainOcclusion")} = skinOcclusion;
#ifdef SKIN_HEAD
skinPlainOcclusion = min(skinOcclusion, vec3(${l.input(occlusion)}.z));
#ifdef SKIN_SCATTERING
skinOcclusion = min(skinOcclusion, vec3(${l.input(bends)}.w, ${l.input(occlusion)}.xy));
#else
skinOcclusion = skinPlainOcclusion;
#endif
#endif
#ifdef SKIN_ENVIRONMENT
${l.local("vec3", "skinIrradiance")} = computeEnvironmentIrradiance(skinToEnvironment(normalW));
#ifdef SKIN_SCATTERING
#ifdef SKIN_BAKED
${l.local("vec3", "skinBandOfMeans")} = skin_band_2_of_means(skinLengths);
// Blue takes green's direction, which is nearly its own.
skinIrradiance = vec3(skinEnvironment(skinToEnvironment(skinToWorld(skinNormalRed)), skinLengths, skinBandOfMeans).r,
                      skinEnvironment(skinToEnvironment(skinToWorld(skinNormalGreen)), skinLengths, skinBandOfMeans).gb);
#else
skinIrradiance = skinEnvironment(skinToEnvironment(normalW), skinBand1(skinCurvature), skinBand2(skinCurvature));
#endif
#endif
finalIrradiance = max(skinIrradiance, vec3(0.0)) * ${l.own("vReflectionColor")} * ${l.own("vReflectionInfos")}.x * surfaceAlbedo *
                  ${l.own("vLightingIntensity")}.z * skinOcclusion;
#endif
#if defined(SKIN_SCATTERING) && defined(SKIN_GAIN)
finalDiffuse *= skinGain;
finalAmbient *= skinGain;
#ifdef REFLECTION
finalIrradiance *= skinGain;
#endif
#endif
#ifdef SKIN_REFLECTION
${l.local("vec3", "skinReflectance")} = getReflectanceFromBRDFLookup(vec3(skinF0), environmentBrdf);
#ifdef SKIN_HEAD
// Lagarde, de Rousiers 2014, "Moving Frostbite to Physically Based Rendering".
${l.local("float", "skinOpen")} = pow(NdotV + skinPlainOcclusion.x, exp2(-16.0 * roughness - 1.0)) - 1.0 + skinPlainOcclusion.x;
skinReflectance *= clamp(skinOpen, 0.0, 1.0);
#else
#if defined(RADIANCEOCCLUSION) && !defined(BENTNORMAL)
skinReflectance *= seo;
#endif
#if defined(HORIZONOCCLUSION) && defined(BUMP) && defined(REFLECTIONMAP_3D)
skinReflectance *= eho;
#endif
#endif
finalRadianceScaled += reflectionOut.environmentRadiance.rgb * skinReflectance * ${l.own("vLightingIntensity")}.z;
#endif`;
