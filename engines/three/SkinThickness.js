// Light that comes through thin parts (ears, nostrils): how thick they are, and the light on their far side.

import { Node, NoColorSpace } from "three/webgpu";
import { cameraWorldMatrix, lightShadowMatrix, materialReference, mix, positionWorld, reference, texture } from "three/tsl";
import { pastFarWallMm } from "./SkinFunction.js";

// Null where no light goes through.
export function thicknessMm({ thicknessNode, thicknessMap }) {
  if (thicknessNode) return thicknessNode;
  if (!thicknessMap) return null;
  if (thicknessMap.colorSpace !== NoColorSpace)
    console.warn("SkinNodeMaterial.thicknessMap: its colorSpace has to be NoColorSpace: it holds lengths, not colours.");
  return texture(thicknessMap).g.mul(materialReference("thicknessMaxMm", "float"));
}

// A second look into a light's shadow map, at another place in world space.
class ShadowAtNode extends Node {
  static get type() { return "ShadowAtNode"; }

  constructor(shadowNode, position) {
    super("vec3");
    this.shadowNode = shadowNode;
    this.position = position;
  }

  setup(builder) {
    const { shadowNode } = this, { light, shadow } = shadowNode;
    shadowNode.build(builder);  // it makes the map
    const { depthTexture } = shadowNode.shadowMap, blurred = shadowNode.vsmShadowMapHorizontal?.texture;
    const visible = shadowNode.setupShadowFilter(builder, {
      filterFn: shadow.filterNode ?? shadowNode.getShadowFilterFn(builder.renderer.shadowMap.type),
      depthTexture: blurred ?? depthTexture,
      shadowCoord: shadowNode.setupShadowCoord(builder, lightShadowMatrix(light).mul(this.position)),
      shadow,
      depthLayer: shadowNode.depthLayer,
    });
    return mix(1, visible, reference("intensity", "float", shadow));
  }
}

// The colour of a light where it enters the far side. Its shadow is looked up past the far wall: at the surface itself the skin
// would shade its own back.
export function colorBehind(lightNode, lightDirection, lightColor, thickness, builder) {
  const { shadowNode, baseColorNode, colorNode } = lightNode;
  if (!shadowNode || !baseColorNode || colorNode === baseColorNode) return lightColor;  // it has no shadow here
  const far = pastFarWallMm(thickness).div(materialReference("mmPerUnit", "float"));
  // Cascades have several maps, and no place in them is known: no shadow.
  const position = positionWorld.add(lightDirection.transformDirection(cameraWorldMatrix).mul(far));
  const visibility = shadowNode.setupShadowCoord ? new ShadowAtNode(shadowNode, position) : 1;
  lightNode.colorNode = baseColorNode.mul(visibility);
  const { lightColor: behind } = lightNode.setupDirect(builder);
  lightNode.colorNode = colorNode;
  return behind;
}
