// Scattering at shadow edges: the light's shadow map is read at places around the point, each weighted by the profile.

import { Node, Vector3, Vector4 } from "three/webgpu";
import {
  BasicShadowFilter, Break, Fn, If, Loop, bool, cross, dot, float, length, lightShadowMatrix, materialReference, positionWorld, reference, select,
  uniformArray, vec2, vec3, vec4,
} from "three/tsl";
import { diskPlaces, firstPlaces, shadowPlaces } from "./SkinShadowPlaces.js";
import {
  diskOffsetMm, gatherBends, gatherCosine, gatherLiftMm, gatherRiseMm, gatherTangent, gatherTrust, gatheredLight, gatheredTrustedLight,
  gatheredWithGain,
} from "./SkinFunction.js";

const offsets = shadowPlaces.map(([x, y, lift]) => new Vector3(x, y, lift));
const weights = shadowPlaces.map(([, , , r, g, b, penumbra]) => new Vector4(r, g, b, penumbra));

class GatheredShadowNode extends Node {
  static get type() { return "GatheredShadowNode"; }

  // All directions are in the mesh's space, of which inWorld() makes the world's; the tensor is in 1/mm. The light is multiplied by the gain later.
  constructor(shadowNode, material, { normal, toLight, diagonal, mixed, gain, inWorld }) {
    super("vec3");
    Object.assign(this, { shadowNode, material, normal, toLight, diagonal, mixed, gain, inWorld });
  }

  // Millimetres of a texel of the shadow map; 0 for a light that is not directional.
  texelMm() {
    const { camera, mapSize } = this.shadowNode.shadow;
    if (!camera.isOrthographicCamera) return float(0);
    return reference("right", "float", camera).sub(reference("left", "float", camera)).div(mapSize.x)
      .mul(materialReference("mmPerUnit", "float"));
  }

  // The visibility at a place in the world.
  seenAt(position, builder) {
    const { shadowNode } = this, { light, shadow } = shadowNode;
    return float(shadowNode.setupShadowFilter(builder, {
      filterFn: BasicShadowFilter,
      depthTexture: shadowNode.shadowMap.depthTexture,
      shadowCoord: shadowNode.setupShadowCoord(builder, lightShadowMatrix(light).mul(vec4(position, 1))),
      shadow,
      depthLayer: shadowNode.depthLayer,
    }));
  }

  // The mean over the disk of an edge of penumbraMm; within Fn.
  visible(texelMm, unitsPerMm, builder) {
    const sum = float(0).toVar(), radius = materialReference("penumbraMm", "float").mul(0.5);
    Loop(diskPlaces, ({ i }) => {
      const offset = this.inWorld(diskOffsetMm(float(i), float(diskPlaces), this.normal, this.toLight, radius, texelMm).toVar());
      sum.addAssign(this.seenAt(positionWorld.add(offset.mul(unitsPerMm)), builder));
    });
    return sum.div(diskPlaces);
  }

  setup(builder) {
    const { shadowNode, material, normal, toLight } = this;
    const filtered = material.penumbraMm > 0 ? null : float(shadowNode).toVar();
    return Fn(() => {
      const texelMm = this.texelMm().toVar(), unitsPerMm = float(1).div(materialReference("mmPerUnit", "float")).toVar();
      const visible = (filtered ?? this.visible(texelMm, unitsPerMm, builder)).toVar();
      if (!material.scattering || !material.scatteredShadow) return vec3(visible);
      const places = uniformArray(offsets, "vec3"), amounts = uniformArray(weights, "vec4");
      const across = select(normal.y.abs().lessThan(0.9), vec3(0, 1, 0), vec3(1, 0, 0)).cross(normal).normalize();
      const x = gatherTangent(normal, toLight, across).toVar(), y = cross(normal, x).toVar();
      const bends = gatherBends(this.diagonal, this.mixed, x, y).toVar();
      const cosine = dot(normal, toLight).toVar(), sine = length(toLight.sub(normal.mul(cosine))).toVar();
      const [xWorld, yWorld, nWorld] = [x, y, normal].map(direction => this.inWorld(direction).toVar());
      const origin = positionWorld.add(nWorld.mul(gatherLiftMm(texelMm).mul(unitsPerMm))).toVar();
      const lit = vec3(0).toVar(), all = vec3(0).toVar(), penumbra = float(0).toVar(), settled = bool(false).toVar();
      const red = vec2(0).toVar();  // lit and all of the places that are trusted
      Loop(shadowPlaces.length, ({ i }) => {
        If(i.equal(firstPlaces).and(lit.x.equal(visible.mul(all.x))), () => {
          settled.assign(true);
          Break();
        });
        const place = places.element(i).toVar(), amount = amounts.element(i).toVar();
        const faces = gatherCosine(place.xy, bends, cosine, sine).toVar();
        const rise = gatherRiseMm(place.xy, place.z, bends);
        const offset = xWorld.mul(place.x).add(yWorld.mul(place.y)).add(nWorld.mul(rise)).mul(unitsPerMm);
        const there = this.seenAt(origin.add(offset), builder).toVar();
        all.addAssign(amount.xyz.mul(faces));
        lit.addAssign(amount.xyz.mul(faces.mul(there)));
        red.addAssign(gatherTrust(place.xy, bends).mul(faces).mul(vec2(there, 1)));
        penumbra.addAssign(amount.w.mul(there));
      });
      const count = float(shadowPlaces.length), gathered = gatheredLight(visible, lit, all, penumbra, count).toVar();
      const trusted = gatheredTrustedLight(visible, gathered, red, penumbra, count);
      return settled.select(vec3(visible), gatheredWithGain(visible, trusted, gathered, this.gain));
    })();
  }
}

// The colour of a light that has entered around the point; as it is where the light has no shadow map of its own.
export function gatheredColor(lightNode, lightColor, material, surface, builder) {
  const { shadowNode, baseColorNode, colorNode } = lightNode;
  if (!shadowPlaces.length || !shadowNode?.setupShadowCoord || !baseColorNode || colorNode === baseColorNode) return lightColor;
  if (shadowNode.light.isPointLight) return lightColor;
  shadowNode.build(builder);  // it makes the map
  lightNode.colorNode = baseColorNode.mul(new GatheredShadowNode(shadowNode, material, surface));
  const { lightColor: entered } = lightNode.setupDirect(builder);
  lightNode.colorNode = colorNode;
  return entered;
}
