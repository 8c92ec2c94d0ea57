// What three.js reads of skin.mtlx and head.glb, as JSON in the message: the numbers that it has a place for. Both are drawn, the
// document's material on the left, the head on the right.

import { DirectionalLight, Mesh, OrthographicCamera, Scene, SphereGeometry, WebGPURenderer } from "three/webgpu";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { MaterialXLoader } from "three/addons/loaders/MaterialXLoader.js";

const message = document.getElementById("message");
try {
  const { materials, warnings } = await new MaterialXLoader().loadAsync("skin.mtlx");
  const { scene: head, parser } = await new GLTFLoader().loadAsync("head.glb");
  const ofDocument = Object.values(materials)[0];
  const [ofHead] = await parser.getDependencies("material");

  const scene = new Scene(), light = new DirectionalLight(0xffffff, Math.PI);
  light.position.set(0, 0, 1);
  const sphere = new Mesh(new SphereGeometry(0.1), ofDocument);
  sphere.position.x = -0.15;
  head.position.x = 0.15;
  scene.add(light, sphere, head);
  const camera = new OrthographicCamera(-0.3, 0.3, 0.3, -0.3, 0, 10);
  camera.position.z = 5;
  const renderer = new WebGPURenderer({ forceWebGL: true });
  await renderer.init();
  document.body.append(renderer.domElement);
  renderer.setSize(innerWidth, innerHeight);
  renderer.render(scene, camera);
  await new Promise(done => requestAnimationFrame(done));
  renderer.render(scene, camera);

  message.textContent = JSON.stringify({
    ignored: warnings.map(({ message }) => message.match(/"(\w+)"/)?.[1] ?? message),
    gltf: {
      color: ofHead.attenuationColor.toArray(), distance_m: ofHead.attenuationDistance, thickness_m: ofHead.thickness,
      ior: ofHead.ior, map: Boolean(ofHead.map && ofHead.normalMap && ofHead.roughnessMap && ofHead.specularIntensityMap),
      profile: ofHead.userData.dermis_profile?.model,
    },
  });
} catch (error) {
  message.textContent = "three.js: " + error.message;
}
