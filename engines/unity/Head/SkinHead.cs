// The head of `dermis export --engine unity SCENE`: meshes with their maps bound, lights, camera and ambient light, as `dermis render` has
// them. In the editor, add the component to an empty object: it builds what is below it from the files of this folder; "Build" in its menu
// does so again. Lengths are metres where a name has no unit; x is mirrored, as glTFast does.
using System;
using System.Collections.Generic;
using UnityEngine;
using UnityEngine.Rendering;
using UnityEngine.Rendering.Universal;
#if UNITY_EDITOR
using UnityEditor;
#endif

namespace Dermis
{
    [ExecuteAlways]
    [AddComponentMenu("Dermis/Skin head")]
    public sealed class SkinHead : MonoBehaviour
    {
        const string kFolder = "Packages/com.dermis.skin/Head/";
        const string kTable = "Packages/com.dermis.skin/Runtime/SkinTable.exr";
        const float kMmPerUnit = 1000.0f;
        const int kShadowMapSide = 4096;

        [SerializeField] TextAsset scene;
        [SerializeField] Material sky;
        [SerializeField] List<Follower> followers = new List<Follower>();

        // A mesh whose skin's curvature follows the weights of its targets.
        [Serializable] sealed class Follower
        {
            public SkinnedMeshRenderer renderer;
            public int[] targets;   // number of each in the picture; below 0: it changes nothing
            public float[] opened;  // their weights as the head opens
            [NonSerialized] public Texture2D weights;
        }

        // scene.json, as JsonUtility reads it.
        [Serializable] sealed class Settings
        {
            public View camera;
            public Bounds bounds;
            public float[] background_linear;
            public float penumbra_mm;
            public Lamp[] lights;
            public Item[] objects;
            public Sky environment;
            public string[] baked_normals;
            public Depth thickness;
        }
        [Serializable] sealed class View { public float[] eye_mm, target_mm, up; public float vertical_fov_rad; }
        [Serializable] sealed class Bounds { public float[] center_mm; public float radius_mm; }
        [Serializable] sealed class Sky { public string file; public float[] ambient_probe; public float intensity, yaw_rad; }
        [Serializable] sealed class Depth { public string file; public float max_mm; }
        [Serializable] sealed class Item { public string file, name; public Surface[] materials; public Changes curvature_of_targets; }
        [Serializable] sealed class Changes { public string file; public string[] targets; public float rows, most_per_mm; }
        [Serializable] sealed class Surface
        {
            public string name, @class;
            public float f0, roughness, normal_scale;
            public float[] albedo_linear;
            public bool object_space_normals, moves;
            public Maps maps;
        }
        [Serializable] sealed class Maps { public string albedo, normal, surface; }
        [Serializable] sealed class Lamp
        {
            public string name, kind;
            public float[] color_linear, to_light, position_mm;
            public float intensity, inner_angle_rad, outer_angle_rad;
            public bool casts_shadow;
        }

        static Vector3 Direction(float[] numbers) => new Vector3(-numbers[0], numbers[1], numbers[2]);
        static Vector3 Metres(float[] lengthsMm) => Direction(lengthsMm) / kMmPerUnit;
        static Color FromLinear(Vector3 color) => new Color(color.x, color.y, color.z).gamma;
        static Vector3 Numbers(float[] numbers) => new Vector3(numbers[0], numbers[1], numbers[2]);

        void OnEnable()
        {
            if (scene == null) return;
            Settings settings = JsonUtility.FromJson<Settings>(scene.text);
            SetAmbientProbe(settings.environment);
            SetSky();
            WarnOfProject(settings);
        }

        // Before the frame is drawn, whoever has set the weights.
        void LateUpdate()
        {
            foreach (Follower one in followers)
                if (one.renderer != null) Follow(one);
        }

        static float Weight(SkinnedMeshRenderer renderer, int target) =>
            renderer.GetBlendShapeWeight(target) / renderer.sharedMesh.GetBlendShapeFrameWeight(target, 0);

        static void Follow(Follower one)
        {
            if (one.weights == null)
                one.weights = new Texture2D(one.targets.Length, 1, TextureFormat.RGBAHalf, false, true) { hideFlags = HideFlags.HideAndDontSave };
            var changed = new Color[one.targets.Length];
            int count = 0;
            for (int i = 0; i < one.targets.Length; ++i)
            {
                float weight = Weight(one.renderer, i) - one.opened[i];
                if (one.targets[i] >= 0 && weight != 0) changed[count++] = new Color(one.targets[i], weight, 0);
            }
            one.weights.SetPixels(changed);
            one.weights.Apply(false);
            foreach (Material material in one.renderer.sharedMaterials)
            {
                if (material == null || !material.HasProperty("_TargetWeights")) continue;
                material.SetTexture("_TargetWeights", one.weights);
                material.SetFloat("_TargetCount", count);
            }
        }

        static void SetAmbientProbe(Sky sky)
        {
            if (sky?.ambient_probe == null || sky.ambient_probe.Length != 27) return;
            var probe = new SphericalHarmonicsL2();
            for (int i = 0; i < 27; ++i) probe[i % 3, i / 3] = sky.ambient_probe[i];
            RenderSettings.ambientMode = AmbientMode.Custom;
            RenderSettings.ambientProbe = probe;
        }

        // What the default reflection probe sees; the camera still shows the plain background.
        void SetSky()
        {
            if (sky == null) return;
            RenderSettings.skybox = sky;
            RenderSettings.defaultReflectionMode = DefaultReflectionMode.Skybox;
            RenderSettings.reflectionIntensity = 1;
            DynamicGI.UpdateEnvironment();
        }

        // What a package may not change in a project, and what it costs.
        void WarnOfProject(Settings settings)
        {
            if (QualitySettings.activeColorSpace != ColorSpace.Linear)
                Debug.LogWarning("Skin head: set Player > Other Settings > Color Space to Linear; its light is wrong in Gamma.", this);
            var pipeline = GraphicsSettings.currentRenderPipeline as UniversalRenderPipelineAsset;
            if (pipeline == null)
            {
                Debug.LogWarning("Skin head: its shader needs URP.", this);
                return;
            }
            float needed = ShadowDistance(settings);
            if (pipeline.shadowDistance > 1.5f * needed || pipeline.shadowDistance < 0.9f * needed)
                Debug.LogWarning($"Skin head: set Shadows > Max Distance of the URP asset to {needed:F2}; its shadows are coarse or missing with " +
                                 $"{pipeline.shadowDistance:F2}.", this);
            if (pipeline.mainLightShadowmapResolution < kShadowMapSide)
                Debug.LogWarning($"Skin head: set Lighting > Main Light > Shadow Resolution of the URP asset to {kShadowMapSide}; edges of " +
                                 $"shadows scatter less with {pipeline.mainLightShadowmapResolution}.", this);
        }

        static float ShadowDistance(Settings settings) =>
            (Metres(settings.camera.eye_mm) - Metres(settings.bounds.center_mm)).magnitude + settings.bounds.radius_mm / kMmPerUnit;

#if UNITY_EDITOR
        void Reset() => Build();

        [ContextMenu("Build")]
        void Build()
        {
            scene = Load<TextAsset>(kFolder + "scene.json");
            if (scene == null) return;
            followers.Clear();
            while (transform.childCount > 0) DestroyImmediate(transform.GetChild(0).gameObject);
            Settings settings = JsonUtility.FromJson<Settings>(scene.text);
            sky = SkyMaterial(settings.environment);
            foreach (Item item in settings.objects) AddObject(item, settings);
            foreach (Lamp lamp in settings.lights) AddLight(lamp);
            AddCamera(settings);
            OnEnable();
        }

        T Load<T>(string path) where T : UnityEngine.Object
        {
            T asset = AssetDatabase.LoadAssetAtPath<T>(path);
            if (asset == null) Debug.LogError($"Skin head: {path} is missing or not imported; export the package again.", this);
            return asset;
        }

        void AddObject(Item item, Settings settings)
        {
            GameObject model = Load<GameObject>(kFolder + item.file);
            if (model == null) return;
            GameObject made = Instantiate(model, transform);
            made.name = item.name;
            var surfaces = new Dictionary<string, Surface>();
            foreach (Surface one in item.materials) surfaces[one.name] = one;
            foreach (Renderer renderer in made.GetComponentsInChildren<Renderer>())
            {
                Material[] materials = renderer.sharedMaterials;
                for (int i = 0; i < materials.Length; ++i)
                {
                    if (materials[i] == null || !surfaces.TryGetValue(materials[i].name, out Surface one)) continue;
                    if (one.@class == "skin") materials[i] = SkinMaterial(one, item, settings);
                    if (one.@class == "translucent") renderer.shadowCastingMode = ShadowCastingMode.Off;
                }
                renderer.sharedMaterials = materials;
                bool hasChanges = !string.IsNullOrEmpty(item.curvature_of_targets?.file);
                if (hasChanges && renderer is SkinnedMeshRenderer skinned && skinned.sharedMesh.blendShapeCount > 0)
                    followers.Add(FollowerOf(skinned, item.curvature_of_targets.targets));
            }
        }

        static Follower FollowerOf(SkinnedMeshRenderer renderer, string[] targets)
        {
            int count = renderer.sharedMesh.blendShapeCount;
            var made = new Follower { renderer = renderer, targets = new int[count], opened = new float[count] };
            for (int i = 0; i < count; ++i)
            {
                made.targets[i] = Array.IndexOf(targets, renderer.sharedMesh.GetBlendShapeName(i));
                made.opened[i] = Weight(renderer, i);
            }
            return made;
        }

        void Bind(Material skin, string property, string file)
        {
            if (!string.IsNullOrEmpty(file)) skin.SetTexture(property, Load<Texture2D>(kFolder + file));
        }

        Material SkinMaterial(Surface one, Item item, Settings settings)
        {
            var skin = new Material(Load<Shader>(kFolder + "SkinHead.shader")) { name = one.name };
            skin.SetTexture("_SkinTable", Load<Texture2D>(kTable));
            Bind(skin, "_BaseMap", one.maps?.albedo);
            Bind(skin, "_NormalMap", one.maps?.normal);
            Bind(skin, "_SurfaceMap", one.maps?.surface);
            Bind(skin, "_ReflectedShares", "reflected_shares.exr");
            skin.SetColor("_BaseColor", FromLinear(Numbers(one.albedo_linear)));
            skin.SetFloat("_BumpScale", one.normal_scale);
            skin.SetFloat("_ObjectSpaceNormals", one.object_space_normals ? 1 : 0);
            skin.SetFloat("_Roughness", one.roughness);
            skin.SetFloat("_F0", one.f0);
            skin.SetFloat("_Moves", one.moves ? 1 : 0);
            skin.SetFloat("_PenumbraMm", settings.penumbra_mm);
            if (settings.baked_normals != null && settings.baked_normals.Length == 3)
            {
                skin.SetFloat("_BakedNormals", 1);
                Bind(skin, "_NormalsRed", settings.baked_normals[0]);
                Bind(skin, "_NormalsGreen", settings.baked_normals[1]);
                Bind(skin, "_NormalsSpread", settings.baked_normals[2]);
            }
            if (!string.IsNullOrEmpty(settings.thickness?.file))
            {
                Bind(skin, "_ThicknessMap", settings.thickness.file);
                skin.SetFloat("_ThicknessMaxMm", settings.thickness.max_mm);
            }
            if (!string.IsNullOrEmpty(item.curvature_of_targets?.file))
            {
                Bind(skin, "_CurvatureOfTargets", item.curvature_of_targets.file);
                skin.SetFloat("_RowsOfTarget", item.curvature_of_targets.rows);
                skin.SetFloat("_MostChangePerMm", item.curvature_of_targets.most_per_mm);
            }
            return skin;
        }

        // Skybox/Panoramic has +x in the middle of a panorama; its tint is multiplied by unity_ColorSpaceDouble.
        Material SkyMaterial(Sky one)
        {
            if (string.IsNullOrEmpty(one?.file)) return null;
            const float kColorSpaceDouble = 4.59479380f;
            var made = new Material(Shader.Find("Skybox/Panoramic")) { name = "Sky" };
            Bind(made, "_MainTex", one.file);
            made.SetFloat("_Rotation", Mathf.Repeat(270 + Mathf.Rad2Deg * one.yaw_rad, 360));
            made.SetColor("_Tint", FromLinear(Vector3.one * (one.intensity / kColorSpaceDouble)));
            return made;
        }

        void AddLight(Lamp lamp)
        {
            var holder = new GameObject(lamp.name);
            holder.transform.SetParent(transform, false);
            Vector3 away = -Direction(lamp.to_light);
            holder.transform.localRotation = Quaternion.LookRotation(away, Mathf.Abs(away.y) < 0.99f ? Vector3.up : Vector3.right);
            Light light = holder.AddComponent<Light>();
            light.type = lamp.kind == "directional" ? LightType.Directional : lamp.kind == "point" ? LightType.Point : LightType.Spot;
            if (light.type != LightType.Directional)
            {
                holder.transform.localPosition = Metres(lamp.position_mm);
                light.range = 100;
            }
            if (light.type == LightType.Spot)
            {
                light.spotAngle = 2 * Mathf.Rad2Deg * lamp.outer_angle_rad;
                light.innerSpotAngle = 2 * Mathf.Rad2Deg * lamp.inner_angle_rad;
            }
            // A colour is at most 1: what is above goes into the intensity. URP's light is an irradiance over pi.
            Vector3 color = Numbers(lamp.color_linear);
            float largest = Mathf.Max(color.x, color.y, color.z, 1e-6f);
            light.color = FromLinear(color / largest);
            light.intensity = lamp.intensity * largest / Mathf.PI;
            light.shadows = lamp.casts_shadow ? LightShadows.Soft : LightShadows.None;
            // The skin's shader lifts the places that it looks up; a bias of the caster would move its shadows.
            light.GetUniversalAdditionalLightData().usePipelineSettings = false;
            light.shadowBias = 0;
            light.shadowNormalBias = 0;
        }

        void AddCamera(Settings settings)
        {
            var holder = new GameObject("Camera");
            holder.transform.SetParent(transform, false);
            Vector3 eye = Metres(settings.camera.eye_mm), target = Metres(settings.camera.target_mm);
            holder.transform.localPosition = eye;
            holder.transform.localRotation = Quaternion.LookRotation(target - eye, Direction(settings.camera.up));
            Camera camera = holder.AddComponent<Camera>();
            camera.fieldOfView = Mathf.Rad2Deg * settings.camera.vertical_fov_rad;
            camera.nearClipPlane = 0.05f;
            camera.farClipPlane = 20;
            camera.clearFlags = CameraClearFlags.SolidColor;
            camera.backgroundColor = FromLinear(Numbers(settings.background_linear));
        }
#endif
    }
}
