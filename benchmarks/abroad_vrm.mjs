// A VRM 1.0 avatar made of our `.rig.glb`, and a `.vrma` on it, as three-vrm plays it: for abroad_three.mjs.
import { VRMLoaderPlugin } from "@pixiv/three-vrm";
import { VRMAnimationLoaderPlugin, VRMLookAtQuaternionProxy, createVRMAnimationClip } from "@pixiv/three-vrm-animation";

// The bones that VRM requires beside head and eyes: all are still, so where they stand makes no difference.
const LIMBS = ["UpperArm", "LowerArm", "Hand", "UpperLeg", "LowerLeg", "Foot"];
const STILL = ["hips", "spine", ...LIMBS.flatMap((limb) => [`left${limb}`, `right${limb}`])];

// Presets as an artist may draw them: shapes with their weights.
const both = (shape, weight) => ({ [`${shape}Left`]: weight, [`${shape}Right`]: weight });
const PRESETS = {
  aa: { jawOpen: 0.7 },
  ih: { jawOpen: 0.15, ...both("mouthStretch", 0.6), ...both("mouthLowerDown", 0.2) },
  ou: { jawOpen: 0.1, mouthPucker: 1.0 },
  ee: { jawOpen: 0.2, ...both("mouthDimple", 0.4), ...both("mouthUpperUp", 0.3) },
  oh: { jawOpen: 0.35, mouthFunnel: 0.8 },
  blinkLeft: { eyeBlinkLeft: 1.0 },
  blinkRight: { eyeBlinkRight: 1.0 },
  happy: both("mouthSmile", 1.0),
  angry: both("browDown", 1.0),
  sad: { browInnerUp: 0.8, ...both("mouthFrown", 0.6) },
  surprised: { browInnerUp: 1.0, ...both("eyeWide", 0.5) },
};

/** Return a binary glTF with its document changed. */
function changed(data, change) {
  const size = new DataView(data).getUint32(12, true);
  const document = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 20, size)));
  change(document);
  let text = new TextEncoder().encode(JSON.stringify(document));
  const room = Math.ceil(text.length / 4) * 4;
  const rest = new Uint8Array(data, 20 + size);
  const result = new Uint8Array(20 + room + rest.length).fill(32, 20, 20 + room);
  result.set(text, 20);
  result.set(rest, 20 + room);
  const view = new DataView(result.buffer);
  for (const [at, value] of [[0, 0x46546c67], [4, 2], [8, result.length], [12, room], [16, 0x4e4f534a]]) {
    view.setUint32(at, value, true);
  }
  return result.buffer;
}

/** Bind an expression to the targets that have its shapes' names, on all meshes. */
function bound(document, shapes) {
  const morphTargetBinds = document.nodes.flatMap((node, at) => {
    const names = document.meshes[node.mesh]?.extras?.targetNames ?? [];
    return names.flatMap((name, index) => (shapes[name] ? [{ node: at, index, weight: shapes[name] }] : []));
  });
  return { morphTargetBinds };
}

function asAvatar(document, expressions) {
  const place = (name) => document.nodes.findIndex((node) => node.name === name);
  const humanBones = { head: { node: place("head") }, leftEye: { node: place("eye_left") }, rightEye: { node: place("eye_right") } };
  for (const bone of STILL) {
    humanBones[bone] = { node: document.nodes.length };
    document.scenes[0].nodes.push(document.nodes.length);
    document.nodes.push({ name: bone });
  }
  // The skin is a mesh whose names hold all 52.
  const names = document.meshes.flatMap((mesh) => mesh.extras?.targetNames ?? []);
  const custom = Object.fromEntries([...new Set(names)].map((name) => [name, bound(document, { [name]: 1.0 })]));
  const preset = Object.fromEntries(Object.entries(PRESETS).map(([name, shapes]) => [name, bound(document, shapes)]));
  const straight = { inputMaxValue: 90.0, outputScale: 90.0 };
  const lookAt = { type: "bone", offsetFromHeadBone: [0.0, 0.06, 0.0] };
  for (const map of ["HorizontalInner", "HorizontalOuter", "VerticalDown", "VerticalUp"]) lookAt[`rangeMap${map}`] = straight;
  document.extensionsUsed = ["VRMC_vrm"];
  document.extensions = {
    VRMC_vrm: {
      specVersion: "1.0",
      meta: { name: "ours", version: "1", authors: ["Risorius"], licenseUrl: "https://vrm.dev/licenses/1.0/" },
      humanoid: { humanBones },
      expressions: expressions === "presets" ? { preset } : { custom },
      lookAt,
    },
  };
  delete document.animations;
}

export async function avatar(asked, bytes, load) {
  const data = changed(bytes(asked.rig), (document) => asAvatar(document, asked.expressions));
  const { vrm } = (await load(data, (parser) => new VRMLoaderPlugin(parser))).userData;
  const animation = (await load(bytes(asked.file), (parser) => new VRMAnimationLoaderPlugin(parser))).userData.vrmAnimations[0];
  const proxy = new VRMLookAtQuaternionProxy(vrm.lookAt);
  proxy.name = "lookAtQuaternionProxy";
  vrm.scene.add(proxy);
  const clip = createVRMAnimationClip(animation, vrm);
  return { scene: vrm.scene, clip, update: () => vrm.update(0) };
}
