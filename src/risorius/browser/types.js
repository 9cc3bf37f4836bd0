/**
 * Types that several parts of the page share, besides those of the wire (`wire.js`) and of the classes themselves.
 *
 * @import {KeyShape, ParameterRow, PauseView, PhoneView, Reason, Tone, WordView} from "./wire.js"
 * @import {Spans} from "./timeline/model/spans.js"
 *
 * The draft in the store:
 * @typedef {Pick<import("./studio/store.js").Parts, "source" | "choices" | "emotions">} Written
 * @typedef {Required<import("./wire.js").EmotionSpan>} EmotionSpan
 * @typedef {{time: number | null, parameter: string | null, movement: string | null}} Selection the selected part
 * @typedef {{values: Record<string, number>, emotions: Record<string, number>}} DialledFace as `Dial` of the wire
 *
 * Elements and their makers:
 * @typedef {Node | string | null | false} Child content of an element; null and false are left out
 * @typedef {Record<string, any>} Attributes as `make` takes them
 * @typedef {HTMLElement & {show: (value: any) => void}} Control one that can be set from outside
 *
 * The timeline:
 * @typedef {import("./wire.js").Block & {free: boolean}} Block a movement, and whether it may be changed
 * @typedef {number[]} Times the four times of a block in seconds: start, end of onset, start of offset, end
 * @typedef {[time: number, value: number, shape?: KeyShape | null]} Key of a curve drawn by hand
 * @typedef {{duration: number, valueAt: (time: number) => number}} Around the curve that a drawn one is tied to
 * @typedef {{kind: string, fields: Record<string, any>}} Edit one of the wire's edits
 * @typedef {{channel: string, priority: number, spans: Spans<Block>, rows: Map<Block, number>, count: number}} Lane
 * @typedef {{base: string, names: string[]}} Base a parameter without its side, and its names with them
 * @typedef {{kind: "ruler" | "wave" | "words" | "phones", y: number, height: number}} SpeechRow
 * @typedef {{kind: "lane", y: number, height: number, lane: Lane, fold: boolean}} LaneRow
 * @typedef {{kind: "graph", y: number, height: number} & Base} GraphRow
 * @typedef {LaneRow | GraphRow} BodyRow
 * @typedef {"both" | "left" | "right"} Sides
 * @typedef {{least: number, most: number, neutral: number, y: (value: number) => number, value: (y: number) => number}} Scale
 * @typedef {{seconds_per_bucket: number, peaks: Int8Array}} Outline the sound's peaks: least, greatest, least, …
 * @typedef {Object} Speech
 * @property {Spans<WordView>} words
 * @property {Spans<PhoneView>} phones
 * @property {Spans<PauseView>} pauses
 * @property {Spans<Tone & {start: number, end: number}>} tones
 * @property {Outline[]} waves
 * @property {number} loudest
 * @typedef {"ground" | "head" | "rule" | "grid" | "text" | "faint" | "wave" | "word" | "pause" | "accent" | "tone"
 *   | "mark" | "loop" | "curve" | "other" | "inhibited" | "limited" | "key" | "label"} ColourName
 * @typedef {Record<ColourName, string> & {channels: Record<string, string>, font: string}} Palette
 * @typedef {Object} ChannelGraph the values that a channel requests of a parameter and receives
 * @property {string} channel
 * @property {Float32Array} asked
 * @property {Float32Array} given
 * @property {[number, number][]} inhibited
 * @property {[number, number][]} limited
 * @typedef {{channels: ChannelGraph[]}} Detail
 * @typedef {Reason & {names: string}} NamedReason
 * @typedef {Map<string, ParameterRow>} Parameters by name
 * @typedef {[top: number, bottom: number]} Band of a block
 * @typedef {{x0: number, y0: number, x1: number, y1: number}} Box
 *
 * The part of the timeline under a point. `handle` of a block: 0 start, 1 end of onset, 2 start of offset, 3 end;
 * `end` of the selection: 0 its start, 1 its end; `phone`: the phone that begins at the edge.
 * @typedef {{kind: "head", row: SpeechRow | null, time: number}
 *   | {kind: "grip", row: SpeechRow | null, end: number, time: number}
 *   | {kind: "marker", row: SpeechRow | null, index: number, time: number}
 *   | {kind: "edge", row: SpeechRow | null, phone: number, time: number}
 *   | {kind: "handle", row: LaneRow, block: Block, handle: number, time: number}
 *   | {kind: "block", row: LaneRow, block: Block, time: number}
 *   | {kind: "lane", row: LaneRow, time: number}
 *   | {kind: "key", row: GraphRow, parameter: string, index: number, time: number}
 *   | {kind: "tangent", row: GraphRow, parameter: string, index: number, side: "before" | "after", time: number}
 *   | {kind: "graph", row: GraphRow, time: number}
 *   | {kind: "none", time: number}} Found
 * @typedef {{move: (x: number, y: number, event: PointerEvent) => void, end: () => void, cancel: () => void}} Gesture
 *
 * The stage:
 * @typedef {(x: number, y: number, width: number, height: number) => void} Cut limits the area to clear
 * @typedef {{order: number[], index: Uint32Array}} Few some of a mesh's vertices, and the triangles between these
 * @typedef {{eyes: number[][], edges: number[][], mouth: number[]}} Spots where the skin is fine, mm
 * @typedef {import("three").Mesh<import("three").BufferGeometry, import("three").Material>} Mesh
 * @typedef {Uint8Array<ArrayBuffer> | Uint16Array<ArrayBuffer> | Uint32Array<ArrayBuffer> | Float32Array<ArrayBuffer>} Numbers
 * @typedef {{array: Numbers, width: number, normalized: boolean}} Attribute of a mesh's vertices, as the file has it
 * @typedef {{attributes: Record<string, Attribute>, index: Uint32Array<ArrayBuffer>, material: {name: string}}} FileMesh
 * @typedef {{name: string, translation?: number[]}} FileNode
 * @typedef {{meshes: Record<string, FileMesh>, nodes: FileNode[], skins: object[], images: Blob[]}} HeadFile
 * @typedef {import("./wire.js").CameraView} CameraState
 * @typedef {Object} HeadData of the server
 * @property {ArrayBuffer} head at rest, as binary glTF
 * @property {ArrayBuffer} shade visibility of the surroundings and of each lamp at rest, for each vertex of the skin, its distance
 *   to the neckline, its blood and gloss, as `head_shade.py` packs them
 * @property {ArrayBuffer} folds the places of its fine wrinkles, as `head_folds.py` packs them
 * @property {ArrayBuffer} skin the tables for shading skin, as `skin_formulas.py` packs them
 *
 * A performance embedded in a page (`player/`):
 * @typedef {Object} PlayedFacts
 * @property {string} fps
 * @property {number} frames
 * @property {number} duration
 * @property {number} chunk how many faces are packed together
 * @property {number} every seconds between explanations
 * @property {import("./wire.js").StageTable} stage
 * @property {[text: string, start: number, end: number][]} words
 * @property {[text: string, start: number, end: number][]} captions
 * @property {{channel: string, blocks: [text: string, start: number, end: number, rule: string, targets: Record<string, number>][]}[]} lanes
 * @property {{lines: string[], times: number[][]}} reasons lines, and the indices of those that apply at each time
 * @typedef {{text: string, start: number, end: number, kind?: string, rule?: string, targets?: Record<string, number>}} PlayedBlock
 */
export {};
