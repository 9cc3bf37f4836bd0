// Generated from wire.py and tables.py by `python -m risorius.studio.wire_types`: do not edit.

/**
 * Add a block. Targets are parameters, action units or aliases.
 * Without `layer` it gets a layer of its own, so that no other block of its channel interrupts it; without
 * `id` it gets the next free one.
 * @typedef {Object} Add
 * @property {"edit"} do
 * @property {"add"} kind
 * @property {string} channel
 * @property {number} start
 * @property {number} end
 * @property {Object<string, number>} targets
 * @property {number} [onset]
 * @property {number} [offset]
 * @property {string|null} [layer]
 * @property {string|null} [function]
 * @property {string|null} [id]
 */
/**
 * Delete the curves drawn by hand for a parameter; a name without its side means both sides.
 * @typedef {Object} ClearKeys
 * @property {"edit"} do
 * @property {"clear_keys"} kind
 * @property {string} parameter
 */
/**
 * Delete a block.
 * @typedef {Object} Delete
 * @property {"edit"} do
 * @property {"delete"} kind
 * @property {string} movement
 */
/**
 * Draw a parameter's curve by hand: keys [time, value] with increasing times replace earlier keys.
 * A name without its side means both sides. `replaces`: from the first key to the last, the curve replaces
 * all other channels; else the highest value shows.
 * @typedef {Object} Keys
 * @property {"edit"} do
 * @property {"keys"} kind
 * @property {string} parameter
 * @property {Array<[number, number]>} keys
 * @property {boolean} [replaces]
 */
/**
 * Move a block so that it starts at `start`.
 * @typedef {Object} Move
 * @property {"edit"} do
 * @property {"move"} kind
 * @property {string} movement
 * @property {number} start
 */
/**
 * Change the targets of a block, by parameter, action unit or alias, or its priority.
 * @typedef {Object} Retarget
 * @property {"edit"} do
 * @property {"retarget"} kind
 * @property {string} movement
 * @property {Object<string, number>|null} [targets]
 * @property {number|null} [priority]
 */
/**
 * Change the times of a block; None leaves a time as it is. Onset, offset: seconds of rise and fall.
 * @typedef {Object} Stretch
 * @property {"edit"} do
 * @property {"stretch"} kind
 * @property {string} movement
 * @property {number|null} [start]
 * @property {number|null} [end]
 * @property {number|null} [onset]
 * @property {number|null} [offset]
 */
/**
 * An emotion to show, over the whole clip, over seconds, or over characters [first, last) of the text.
 * @typedef {Object} EmotionSpan
 * @property {string} emotion
 * @property {number} intensity
 * @property {number|null} [start]
 * @property {number|null} [end]
 * @property {number|null} [first]
 * @property {number|null} [last]
 */
/**
 * The settings of a performance that a page may choose; null is the library's own default.
 * `rules_off`: ids of rules, or their beginnings up to a dot, that do not hold. `profile_text`: a profile
 * edited in the page (TOML); it goes before `profile`.
 * @typedef {Object} Choices
 * @property {string|null} [language]
 * @property {string|null} [voice]
 * @property {number|null} [rate]
 * @property {boolean} [voice_emotion]
 * @property {number} [lead]
 * @property {number} [tail]
 * @property {string} [profile]
 * @property {Array<string>} [attitudes]
 * @property {boolean} [lively]
 * @property {string} [manner]
 * @property {number} [articulation]
 * @property {Array<string>} [without]
 * @property {string} [head]
 * @property {number|null} [age]
 * @property {string} [dynamics]
 * @property {number} [seed]
 * @property {string} [fps]
 * @property {string|null} [hair]
 * @property {number|null} [complexion]
 * @property {string} [conflict]
 * @property {number|null} [activation_threshold]
 * @property {number|null} [min_onset]
 * @property {number|null} [min_offset]
 * @property {string|null} [onset_function]
 * @property {boolean} [contact]
 * @property {string} [lips]
 * @property {string|null} [profile_text]
 * @property {Array<string>} [rules_off]
 */
/**
 * What is performed: a script as text of a format, and a recording (by the name its upload was given).
 * With a recording the text is its transcript; an empty one has the words recognized.
 * @typedef {Object} Source
 * @property {string} [script]
 * @property {"text"|"xml"|"utt"|"ssml"|"bml"|"score"|"TextGrid"} [format]
 * @property {string|null} [recording]
 */
/**
 * Ask for the session's state; answered by State.
 * @typedef {Object} Open
 * @property {"open"} do
 */
/**
 * Perform a script anew; edits of blocks that are there again are kept. Answered by TakeView.
 * The voice is synthesized only if something that it depends on has changed.
 * @typedef {Object} Perform
 * @property {"perform"} do
 * @property {Source} source
 * @property {Choices} [choices]
 * @property {Array<EmotionSpan>} [emotions]
 */
/**
 * Have ready what Perform with the same fields will ask, where it is short. Answered by Done, always.
 * @typedef {Object} Prepare
 * @property {"prepare"} do
 * @property {Source} source
 * @property {Choices} [choices]
 * @property {Array<EmotionSpan>} [emotions]
 */
/**
 * Perform the same script with other choices or emotions (those left out stay). Answered by TakeView.
 * @typedef {Object} Choose
 * @property {"choose"} do
 * @property {Choices|null} [choices]
 * @property {Array<EmotionSpan>|null} [emotions]
 */
/**
 * What an edit would do, which is not made: `{"do": "preview", "kind": KIND, …}` with the edit's fields.
 * Answered by Previewed; with `face`, a time, the face as it would be held there then comes before.
 * @typedef {Object} Preview
 * @property {Move|Stretch|Retarget|Add|Delete|Keys|ClearKeys} edit
 * @property {number|null} [face]
 */
/**
 * Take the last change back; answered by TakeChange.
 * @typedef {Object} Undo
 * @property {"undo"} do
 */
/**
 * Make the change that was taken back last again; answered by TakeChange.
 * @typedef {Object} Redo
 * @property {"redo"} do
 */
/**
 * Send the faces of frames [first, last) of a take, in binary messages; answered when all are sent.
 * A request takes the place of the one before for the same take: that is then answered with the frames
 * sent. With `pace` no more than so many frames a second are sent after those of the first second.
 * @typedef {Object} Faces
 * @property {"faces"} do
 * @property {number} take
 * @property {number} first
 * @property {number} last
 * @property {number|null} [pace]
 */
/**
 * Send the one face at a time, that of the nearest frame.
 * `still`: as if it were held there, the skin at rest, which is there much sooner: for who scrubs.
 * @typedef {Object} FaceAt
 * @property {"face_at"} do
 * @property {number} take
 * @property {number} time
 * @property {boolean} [still]
 */
/**
 * Stop sending a take's faces.
 * @typedef {Object} Cancel
 * @property {"cancel"} do
 * @property {number} take
 */
/**
 * Hold a face: parameters, action units and emotions by name; answered by DialState, and faces follow.
 * `live`: the skin moves there as springs do; the face at rest there at once otherwise.
 * @typedef {Object} Dial
 * @property {"dial"} do
 * @property {Object<string, number>} [values]
 * @property {Object<string, number>} [emotions]
 * @property {boolean} [live]
 * @property {string} [head]
 * @property {number|null} [age]
 */
/**
 * Keep the dialled face under a name, as a pose or as an emotion; answered by PoseFile.
 * @typedef {Object} SavePose
 * @property {"name_pose"} do
 * @property {string} name
 * @property {"pose"|"emotion"} kind
 * @property {Object<string, number>} values
 */
/**
 * Say why a parameter (all that move if null) has its value; answered by Explained.
 * @typedef {Object} Explain
 * @property {"explain"} do
 * @property {number} take
 * @property {number} time
 * @property {string|null} [parameter]
 */
/**
 * Ask what each channel asks of a parameter and gets, over the take; answered by ParameterDetail.
 * @typedef {Object} ChannelCurves
 * @property {"channel_curves"} do
 * @property {number} take
 * @property {string} parameter
 */
/**
 * Perform the session's script with other choices as a second take beside it; answered by TakeView.
 * @typedef {Object} Compare
 * @property {"compare"} do
 * @property {Choices} choices
 * @property {Array<EmotionSpan>|null} [emotions]
 */
/**
 * Ask which rules fired where; answered by Fired.
 * @typedef {Object} RulesFired
 * @property {"rules_fired"} do
 * @property {number} take
 */
/**
 * Ask for a profile as TOML, with numbers changed by dotted key ("blinks.wait"); answered by ProfileFile.
 * `base` is the profile's name; `name` what the new one is called.
 * @typedef {Object} ProfileText
 * @property {"profile_save"} do
 * @property {string} base
 * @property {string} name
 * @property {Object<string, number>} [numbers]
 */
/**
 * Write a take as files of these suffixes; answered by Job, then progress and exported events.
 * @typedef {Object} Export
 * @property {"export"} do
 * @property {number} take
 * @property {Array<string>} suffixes
 * @property {string} [name]
 * @property {string} [size]
 * @property {number|null} [at]
 * @property {number|null} [every]
 * @property {string} [style]
 * @property {string} [camera]
 * @property {number} [lens]
 * @property {string} [light]
 * @property {string|null} [background]
 * @property {string} [quality]
 * @property {Array<string>} [overlay]
 */
/**
 * Stop an export.
 * @typedef {Object} CancelExport
 * @property {"cancel_export"} do
 * @property {number} job
 */
/**
 * Ask for the project file; answered by Download.
 * @typedef {Object} Project
 * @property {"project"} do
 */
/**
 * Keep what the page shows (camera, tab, playhead …) with the project; the server does not look in.
 * @typedef {Object} View
 * @property {"view"} do
 * @property {Object<string, any>} view
 */
/**
 * A word, its place in the script's text, seconds.
 * @typedef {Object} Word
 * @property {string} text
 * @property {number} start
 * @property {number} end
 * @property {number} first
 * @property {number} last
 */
/**
 * A speech sound; "" is silence. `word` -1 for none. Seconds.
 * @typedef {Object} Phone
 * @property {string} symbol
 * @property {number} start
 * @property {number} end
 * @property {number} stress
 * @property {number} word
 */
/**
 * A pitch accent or the tones that end a phrase, as ToBI labels them.
 * @typedef {Object} Tone
 * @property {number} time
 * @property {string} label
 * @property {number} word
 * @property {boolean} accent
 * @property {boolean} nuclear
 */
/**
 * A silence and what it stands for. Seconds.
 * @typedef {Object} Pause
 * @property {number} start
 * @property {number} end
 * @property {string} kind
 */
/**
 * A movement on its lane. `apex_start`: end of its onset; `apex_end`: start of its offset. Seconds.
 * `cause` is a sentence; `rule` the id of what made it. `editable` is false for the lips' phones. `edited`:
 * it is not as the rules made it.
 * @typedef {Object} Block
 * @property {string} id
 * @property {string} channel
 * @property {string} layer
 * @property {string} label
 * @property {number} start
 * @property {number} apex_start
 * @property {number} apex_end
 * @property {number} end
 * @property {Object<string, number>} targets
 * @property {number} priority
 * @property {string} function
 * @property {string} cause
 * @property {string} rule
 * @property {boolean} [editable]
 * @property {boolean} [edited]
 */
/**
 * A parameter's curve drawn by hand: keys [time, value]. `replaces`: as in Keys.
 * @typedef {Object} Drawn
 * @property {string} parameter
 * @property {Array<[number, number]>} keys
 * @property {string} cause
 * @property {boolean} replaces
 */
/**
 * The sound's peaks at one zoom: base64 of int8 pairs (least, greatest), one pair per bucket.
 * @typedef {Object} Wave
 * @property {number} seconds_per_bucket
 * @property {string} peaks
 */
/**
 * What is said in a take. `sound`: the path to fetch it from. `waves`: coarse to fine.
 * @typedef {Object} Spoken
 * @property {string} text
 * @property {string} language
 * @property {string} sound
 * @property {Array<Word>} words
 * @property {Array<Phone>} phones
 * @property {Array<Tone>} tones
 * @property {Array<Pause>} pauses
 * @property {Array<Wave>} waves
 */
/**
 * How the session's take came about: what is asked again by `perform`.
 * @typedef {Object} Made
 * @property {Source} source
 * @property {Choices} choices
 * @property {Array<EmotionSpan>} emotions
 */
/**
 * A take whole. `fps` as "24000/1001". `speech` is null where nothing is said.
 * `curves`: of the parameters that move, `frames` values each; the others stay at their neutral.
 * `warnings`: what was done otherwise than asked. `milliseconds`: what each step took.
 * @typedef {Object} TakeView
 * @property {number} take
 * @property {number} duration
 * @property {string} fps
 * @property {number} frames
 * @property {Spoken|null} speech
 * @property {Array<Block>} blocks
 * @property {Array<Drawn>} drawn
 * @property {Object<string, string>} curves
 * @property {Made} made
 * @property {string} undoes
 * @property {string} redoes
 * @property {Array<string>} warnings
 * @property {Object<string, number>} milliseconds
 */
/**
 * What a change made of take `before`: blocks that are new or other, ids of those gone, changed curves.
 * A parameter that has come to rest has the curve "". Where speech itself is another, `whole` has the take
 * and the rest is empty. `from_frame`, `to_frame`: the frames whose faces are other, [from, to).
 * @typedef {Object} TakeChange
 * @property {number} take
 * @property {number} before
 * @property {Array<Block>} blocks
 * @property {Array<string>} gone
 * @property {Array<Drawn>} drawn
 * @property {Object<string, string>} curves
 * @property {number} from_frame
 * @property {number} to_frame
 * @property {Made} made
 * @property {string} undoes
 * @property {string} redoes
 * @property {TakeView|null} whole
 * @property {Array<string>} warnings
 */
/**
 * A session as it stands: its take (null before the first), what was uploaded and saved under a name.
 * `view`: what the page kept of itself. `notes`: what could not be taken up from what was saved.
 * @typedef {Object} State
 * @property {string} session
 * @property {TakeView|null} take
 * @property {Array<string>} recordings
 * @property {Array<string>} emotions
 * @property {Object<string, Object<string, number>>} poses
 * @property {Object<string, any>} view
 * @property {Array<string>} notes
 */
/**
 * How many faces were sent.
 * @typedef {Object} Sent
 * @property {number} sent
 */
/**
 * It is done.
 * @typedef {Object} Done
 */
/**
 * All parameters that the dialled face holds, by name; `notes` name what could not be shown.
 * @typedef {Object} DialState
 * @property {Object<string, number>} values
 * @property {Array<string>} notes
 */
/**
 * A file to be fetched from `path`.
 * @typedef {Object} Download
 * @property {string} path
 * @property {string} name
 */
/**
 * What one movement asks of a parameter and gets (deviations from neutral), and why not more.
 * @typedef {Object} Part
 * @property {string} channel
 * @property {string} what
 * @property {string} rule
 * @property {string} place
 * @property {number} asked
 * @property {number} given
 * @property {string} reason
 * @property {string} [movement]
 */
/**
 * Why a parameter has its value: what wins (null at rest), what does not and why, the last steps.
 * @typedef {Object} Reason
 * @property {string} parameter
 * @property {number} value
 * @property {string} unit
 * @property {Part|null} winner
 * @property {Array<Part>} losers
 * @property {Array<string>} notes
 */
/**
 * Explanations, as data and in sentences (as `risorius explain` prints them).
 * @typedef {Object} Explained
 * @property {number} time
 * @property {Array<Reason>} reasons
 * @property {Array<string>} sentences
 */
/**
 * What a channel asks of a parameter and what it gets, `frames` values each.
 * `inhibited`: spans [start, end] in seconds in which nothing is left of it; `limited`: less than asked.
 * @typedef {Object} ChannelCurve
 * @property {string} channel
 * @property {string} asked
 * @property {string} given
 * @property {Array<[number, number]>} inhibited
 * @property {Array<[number, number]>} limited
 */
/**
 * The curves that would be other in a take, in base64 as in TakeView; "" where one would come to rest.
 * @typedef {Object} Previewed
 * @property {number} take
 * @property {Object<string, string>} curves
 */
/**
 * All channels in one parameter.
 * @typedef {Object} ParameterDetail
 * @property {string} parameter
 * @property {Array<ChannelCurve>} channels
 */
/**
 * A rule, its comment, the ids of its blocks and when each starts.
 * @typedef {Object} FiredRule
 * @property {string} rule
 * @property {string} comment
 * @property {Array<string>} blocks
 * @property {Array<number>} times
 */
/**
 * The rules that fired in a take, in order of their ids.
 * @typedef {Object} Fired
 * @property {Array<FiredRule>} rules
 */
/**
 * A profile as TOML, to be kept as a file or performed by `choices.profile_text`.
 * @typedef {Object} ProfileFile
 * @property {string} name
 * @property {string} text
 */
/**
 * What was saved under a name, as a file: an emotion (TOML), or the command that makes the pose.
 * @typedef {Object} PoseFile
 * @property {string} name
 * @property {string} file
 * @property {string} text
 */
/**
 * An export that has begun.
 * @typedef {Object} Job
 * @property {number} job
 */
/**
 * How far a request (`re`) or an export (`job`) is; `total` 0 where that is not known.
 * @typedef {Object} Progress
 * @property {"progress"} event
 * @property {string} stage
 * @property {number} done
 * @property {number} total
 * @property {number|null} re
 * @property {number|null} job
 */
/**
 * An export has ended: its files, or why there are none.
 * @typedef {Object} Exported
 * @property {"exported"} event
 * @property {number} job
 * @property {Array<Download>} files
 * @property {string} error
 */
/**
 * Another page of the same session has changed it: its take is another now.
 * @typedef {Object} Changed
 * @property {"changed"} event
 * @property {number} take
 */
/**
 * The project was saved by itself; `error` says why it could not be.
 * @typedef {Object} Saved
 * @property {"saved"} event
 * @property {string} error
 */
/**
 * Whether the server is still "warming" (kernels are compiled; the first face waits), or is "warm".
 * @typedef {Object} Ready
 * @property {"ready"} event
 * @property {"warming"|"warm"} what
 */
/**
 * A column of every curve, as `core.parameters.Parameter`; `rivals` are those that it conflicts with.
 * @typedef {Object} ParameterRow
 * @property {string} name
 * @property {string} base
 * @property {string} side
 * @property {string} kind
 * @property {string} group
 * @property {string} unit
 * @property {number} low
 * @property {number} high
 * @property {number} neutral
 * @property {number|null} number
 * @property {number} threshold
 * @property {number} min_onset
 * @property {number} min_offset
 * @property {boolean} signed
 * @property {Array<string>} rivals
 */
/**
 * An action unit, with the parameters' values at full intensity.
 * @typedef {Object} UnitRow
 * @property {string} name
 * @property {number} number
 * @property {string} title
 * @property {boolean} approximate
 * @property {Object<string, number>} targets
 */
/**
 * An emotion: its action units, and the parameters' values at full intensity. Seconds.
 * @typedef {Object} EmotionRow
 * @property {string} name
 * @property {Array<string>} aliases
 * @property {string} description
 * @property {Object<string, number>} units
 * @property {Object<string, number>} targets
 * @property {number} onset
 * @property {number} offset
 */
/**
 * A number of a profile by its dotted key; null where its range has no end.
 * @typedef {Object} NumberRow
 * @property {string} key
 * @property {number} value
 * @property {number|null} low
 * @property {number|null} high
 */
/**
 * A speaker, its numbers by key, and its file.
 * @typedef {Object} ProfileRow
 * @property {string} name
 * @property {string} description
 * @property {string} source
 * @property {Object<string, NumberRow>} numbers
 * @property {string} text
 */
/**
 * What a speaker may want to convey.
 * @typedef {Object} AttitudeRow
 * @property {string} name
 * @property {string} description
 * @property {string} source
 */
/**
 * A voice; those named `+name` change the timbre of any other.
 * @typedef {Object} VoiceRow
 * @property {string} name
 * @property {string} language
 * @property {string} title
 */
/**
 * A head, who it is, how old and with which hair.
 * @typedef {Object} HeadRow
 * @property {string} name
 * @property {string} title
 * @property {number} age
 * @property {string} hair
 */
/**
 * A channel and its default priority.
 * @typedef {Object} ChannelRow
 * @property {string} name
 * @property {number} priority
 */
/**
 * An onset function, with its values at even steps from 0 to 1.
 * @typedef {Object} OnsetRow
 * @property {string} name
 * @property {string} description
 * @property {Array<number>} samples
 */
/**
 * A rule of the package.
 * @typedef {Object} RuleRow
 * @property {string} id
 * @property {string} channel
 * @property {string} level
 * @property {number} probability
 * @property {string} comment
 * @property {Array<string>} conditions
 */
/**
 * A format of files, by suffix.
 * @typedef {Object} OutputRow
 * @property {string} suffix
 * @property {string} description
 * @property {Array<string>} needs
 */
/**
 * A value that a setting may have: its name, what is said of it, and what is sent for it.
 * @typedef {Object} ChoiceRow
 * @property {string} name
 * @property {string} description
 * @property {string|number} value
 */
/**
 * A setting as a control: `key` of the choices or, if it is `exported`, of an export.
 * `control`: "choice" (of `choices`), "several" (of them), "check", "number", "slider" or "text".
 * `optional`: whether it may be null, which `unset` says in words.
 * @typedef {Object} SettingRow
 * @property {string} key
 * @property {string} label
 * @property {string} group
 * @property {string} control
 * @property {boolean} exported
 * @property {string} help
 * @property {number|null} low
 * @property {number|null} high
 * @property {number|null} step
 * @property {boolean} optional
 * @property {string} unset
 * @property {any} default
 * @property {Array<ChoiceRow>} choices
 */
/**
 * Characters of a script; bytes of a recording, a project, a message; requests at once; undos.
 * @typedef {Object} LimitsTable
 * @property {number} script
 * @property {number} recording
 * @property {number} project
 * @property {number} message
 * @property {number} pending
 * @property {number} undo
 */
/**
 * `GET /api/catalogue`: all that can be named. `choices` are the defaults.
 * @typedef {Object} Catalogue
 * @property {string} version
 * @property {Array<ParameterRow>} parameters
 * @property {Object<string, string>} aliases
 * @property {Array<UnitRow>} action_units
 * @property {Array<EmotionRow>} emotions
 * @property {Array<ProfileRow>} profiles
 * @property {Array<AttitudeRow>} attitudes
 * @property {Array<VoiceRow>} voices
 * @property {Array<HeadRow>} heads
 * @property {Array<ChannelRow>} channels
 * @property {Array<OnsetRow>} onset_functions
 * @property {Array<SettingRow>} settings
 * @property {Array<string>} formats
 * @property {Array<RuleRow>} rules
 * @property {Array<OutputRow>} outputs
 * @property {Choices} choices
 * @property {LimitsTable} limits
 */
/**
 * A mesh of which vertices are sent: the first of them, how many, and its mesh's origin in mm.
 * @typedef {Object} StagePart
 * @property {string} name
 * @property {number} first
 * @property {number} count
 * @property {[number, number, number]} about
 */
/**
 * A lamp: from where it shines, and its linear colour.
 * @typedef {Object} StageLamp
 * @property {[number, number, number]} direction
 * @property {[number, number, number]} colour
 */
/**
 * The light that a head is drawn in: lamps, and the linear ambient light from above and below.
 * @typedef {Object} StageLight
 * @property {Array<StageLamp>} lamps
 * @property {[number, number, number]} sky
 * @property {[number, number, number]} ground
 */
/**
 * `GET /api/stage`: how faces are unpacked: `origin + step * value` mm; `pose` floats a face; mm.
 * `lips` are the skin's vertices of the upper and the lower lip that touch when the mouth is shut; `cloth`
 * is the linear colour of what is worn.
 * @typedef {Object} StageTable
 * @property {number} vertices
 * @property {number} pose
 * @property {number} step
 * @property {[number, number, number]} origin
 * @property {[number, number, number]} pivot
 * @property {[[number, number, number], [number, number, number]]} eyes
 * @property {Array<[number, number]>} lips
 * @property {StageLight} light
 * @property {[number, number, number]} cloth
 * @property {Array<StagePart>} parts
 */
/** @typedef {"open" | "perform" | "prepare" | "choose" | "undo" | "redo" | "faces" | "face_at" | "cancel" | "dial" | "name_pose" | "explain" | "channel_curves" | "compare" | "rules_fired" | "profile_save" | "export" | "cancel_export" | "project" | "view"} Verb */
/** @typedef {"move" | "stretch" | "retarget" | "add" | "delete" | "keys" | "clear_keys"} EditKind */
/** @typedef {"progress" | "exported" | "changed" | "saved" | "ready"} EventName */
export {};
