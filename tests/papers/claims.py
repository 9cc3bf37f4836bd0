"""Each claim of both papers in our words, with the tests that read it off the curves.

The pages `docs/paper-a.md` and `docs/paper-b.md` have the claims with what implements them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Claim:
    """What a paper says in a `section`, and its `tests`: files below tests/ and functions without test_."""

    section: str
    says: str
    tests: tuple[str, ...]


CLAIMS: Mapping[str, Claim] = {
    "A1": Claim(
        "4",
        "a movement rises by φ₊, holds, falls by φ₋, and is 0 outside (Figure 4)",
        (
            "papers/test_combination::one_movement_is_the_formula",
            "test_paper_formulas::a_movement_rises_holds_and_falls_by_paper_a_s_functions",
        ),
    ),
    "A2": Claim(
        "5.2",
        "to a higher target it rises by the second onset from where it is (case 1)",
        (
            "test_paper_formulas::a_channel_rises_to_a_higher_target_early_and_waits",
            "blend/test_concatenate::rise_meets_a_higher_target_early",
        ),
    ),
    "A3": Claim(
        "5.2",
        "to a lower target it falls by the first offset (case 2, Figure 5)",
        (
            "test_paper_formulas::movements_of_a_channel_concatenate_by_paper_a_s_formulas",
            "blend/test_concatenate::figure_5_releases_to_a_lower_target",
        ),
    ),
    "A4": Claim(
        "5.2",
        "a release that meets an offset is that offset only from 1 to 0",
        ("papers/test_combination::a_release_is_the_first_movement_s_own_only_from_1_to_0",),
    ),
    "A5": Claim(
        "5.2",
        "a muscle of the first movement alone is released, one of the second alone rises",
        ("papers/test_combination::what_the_second_movement_lacks_is_released_and_what_it_adds_rises",),
    ),
    "A6": Claim(
        "5.2",
        "further movements are combined in the same manner",
        ("papers/test_combination::more_movements_follow_in_the_same_manner",),
    ),
    "A7": Claim(
        "5.2",
        "movements of a channel follow one another",
        (
            "core/test_score::bad_scores",
            "blend/test_concatenate::the_outer_resumes_where_the_inner_lets_go",
        ),
    ),
    "A8": Claim(
        "4",
        "onset and offset fit into the movement",
        ("blend/test_concatenate::onset_and_offset_too_long_shrink_in_proportion",),
    ),
    "A9": Claim(
        "5.2",
        "a release longer than the next onset makes no jump",
        ("blend/test_concatenate::release_longer_than_the_next_onset_has_no_jump",),
    ),
    "A10": Claim(
        "2",
        "a channel holds only movements that do not conflict",
        (
            "blend/test_layer_priority::rivals_in_one_movement_sum_to_one_at_most",
            "rules/test_fuzzy::of_rivals_of_two_emotions_the_weaker_stays_at_rest",
            "channels/test_emotion_company::two_options_show_what_one_tag_does",
        ),
    ),
    "A11": Claim(
        "3",
        "35 muscles (Table 1)",
        (
            "papers/test_combination::each_of_the_35_muscles_moves_the_skin",
            "core/test_parameters::there_are_35_muscles_in_19_rows",
        ),
    ),
    "A12": Claim(
        "3",
        "which muscles conflict (Table 2)",
        (
            "papers/test_combination::every_pair_of_muscles_is_a_rival_as_table_2_has_it",
            "core/test_parameters::table_2_has_twenty_pairs",
        ),
    ),
    "A13": Claim(
        "3",
        "left and right are muscles of their own",
        (
            "core/test_parameters::conflict_is_tested_per_side",
            "blend/policies/test_policies::the_other_side_is_free_of_a_sided_rival",
        ),
    ),
    "A14": Claim(
        "6",
        "a muscle is 0 while a rival of higher priority is active, and min(F, Ψ←, Ψ→) around it (Figure 6)",
        (
            "papers/test_combination::a_muscle_gives_way_by_psi_whatever_the_minimum",
            "test_paper_formulas::a_rival_inhibits_by_paper_a_s_formula",
        ),
    ),
    "A15": Claim(
        "6",
        "only an activated rival inhibits",
        ("blend/policies/test_policies::a_rival_at_its_threshold_inhibits_nothing",),
    ),
    "A16": Claim(
        "6",
        "the largest value of all channels is shown",
        (
            "test_paper_formulas::the_largest_of_the_channels_is_shown_and_exponentials_have_paper_a_s_shape",
            "blend/test_directions::the_formula",
        ),
    ),
    "A17": Claim(
        "1",
        "speech outranks a smile, and a smile outranks speech when one is too happy to speak",
        (
            "blend/policies/test_policies::an_overwhelming_emotion_wins_over_speech",
            "test_overwhelmed::a_smile_of_full_intensity_leaves_the_lips_no_rounding",
        ),
    ),
    "A18": Claim(
        "2",
        "the input is a text with atomic movements, or these alone",
        (
            "script/test_markup::the_papers_example_as_printed",
            "papers/test_speech::a_display_needs_no_words",
            "papers/test_speech::a_listener_without_words_nods_and_blinks_back",
        ),
    ),
    "A19": Claim(
        "5.1",
        "lips are the average of targets weighted by dominance e^(−θτ^c)",
        (
            "blend/mouth/test_dominance::the_curve_is_that_of_the_printed_formula",
            "blend/mouth/test_dominance::dominant_neighbours_win",
        ),
    ),
    "A20": Claim(
        "2",
        "random blinks by the algorithm of Itti et al.",
        (
            "test_paper_formulas::random_blinks_of_itti_wait_since_the_last_shift_of_attention_or_blink",
            "channels/test_manipulators::itti_s_blinks_come_10_to_20_times_a_minute_in_silence",
        ),
    ),
    "A21": Claim(
        "2",
        "the settings are the paper's (`--preset paper-a`)",
        ("channels/test_paper_speakers::the_presets_of_the_papers_are_complete_and_say_what_stays_ours",),
    ),
    "A22": Claim(
        "2",
        "signals on accents, hesitations and punctuation, and a listener's feedback",
        (
            "papers/test_speech::hesitations_and_exclamations_are_punctuated",
            "papers/test_speech::most_accents_gather_several_kinds_of_movement",
            "channels/test_rules_at_work::listeners_nod_and_blink_back",
        ),
    ),
    "A23": Claim(
        "2",
        "displays of what is felt, emblems of what is spoken of",
        (
            "test_paper_formulas::an_emblem_is_weaker_shorter_and_a_part_of_its_display",
            "channels/test_rules_at_work::an_emblem_of_what_is_displayed_already_is_not_shown",
        ),
    ),
    "A24": Claim(
        "2",
        "displays follow emotions by fuzzy rules",
        (
            "rules/test_fuzzy::at_a_set_s_centre_its_rule_alone_speaks",
            "rules/test_emotions::contractions_are_continuous_and_never_fall_as_the_intensity_rises",
        ),
    ),
    "A25": Claim(
        "2",
        "gaze and head make contact, point, say yes and no, and are never quite at rest",
        (
            "papers/test_speech::a_yes_is_nodded",
            "papers/test_speech::a_head_at_rest_is_never_quite_still_unless_wanted",
            "channels/test_eye_head::a_marked_look_is_shared_with_the_head",
        ),
    ),
    "A26": Claim(
        "3",
        "conflicting muscles that are only added make an unnatural face (Figure 3)",
        ("test_figures::figure_3_the_higher_priority_presses",),
    ),
    "A27": Claim(
        "6",
        "the demonstration (Figure 7)",
        (
            "test_paper_a::it_gives_way_before_the_lips_round_and_no_faster_than_it_can",
            "test_paper_a::it_returns_to_full_when_all_is_said",
            "charts/test_figures::the_page_has_its_frames_as_they_are",
        ),
    ),
    "A28": Claim(
        "2",
        "the face moves in time with the sound",
        (
            "papers/test_speech::the_sound_begins_with_the_first_phone_and_ends_with_the_last",
            "ports/video/test_mp4::flash_and_click_agree_within_a_millisecond",
        ),
    ),
    "A29": Claim(
        "3",
        "bulges and wrinkles",
        (
            "face/skin/test_bulges::each_bulge_swells_under_its_muscles",
            "face/skin/test_wrinkles::every_region_folds_under_its_muscles_and_deepens_with_age",
        ),
    ),
    "A30": Claim(
        "7",
        "other functions of onset and offset, and felt displays",
        (
            "test_figures::onset_functions_meet_every_target",
            "rules/test_expressions::posed_smiles_rise_faster_and_less_smoothly",
        ),
    ),
    "A31": Claim(
        "4",
        "defaults are those that the help names",
        ("cli/test_options::mix_combines_a_score_that_says_nothing_by_the_defaults_that_its_help_names",),
    ),
    "B1": Claim(
        "2.1.1",
        "channels are independent and can be switched off",
        (
            "papers/test_speech::a_channel_that_is_left_out_leaves_the_other_curves",
            "channels/test_compose::a_channel_does_not_change_when_another_is_left_out",
        ),
    ),
    "B2": Claim(
        "3.2",
        "rules of one channel are changed, added and deleted without the rest",
        (
            "test_paper_rows::a_rule_of_one_channel_changes_and_the_rest_stays",
            "rules/test_rule_set::a_file_adds_replaces_and_deletes_without_touching_ours",
        ),
    ),
    "B3": Claim(
        "3.2.1",
        "individuality and attitude are sets of type and timing",
        (
            "rules/test_speakers::speakers_differ_in_the_units_and_in_the_times_of_an_accent",
            "rules/test_speakers::an_ironic_nucleus_raises_one_brow",
            "test_paper_rows::type_and_time_are_two_variables",
        ),
    ),
    "B4": Claim(
        "4.1",
        "signals work on words or, in slow speech, on syllables",
        (
            "papers/test_speech::signals_are_of_syllables_in_slow_speech_and_of_words_else",
            "rules/test_match::items_are_syllables_in_slow_speech_and_words_else",
        ),
    ),
    "B5": Claim(
        "3.1",
        "what the face does begins and is whole on phonemes",
        (
            "papers/test_speech::brows_and_mouth_begin_and_are_whole_on_phonemes",
            "papers/test_speech::natural_blinks_begin_on_phonemes_and_need_not_end_there",
            "test_paper_rows::what_the_face_does_begins_and_is_whole_on_phonemes",
        ),
    ),
    "B6": Claim(
        "4.1",
        "emotion changes neither type nor place of accents",
        (
            "speech/test_plain_breaks::no_emotion_moves_an_accent_or_a_boundary",
            "channels/test_rules_at_work::emotion_changes_neither_place_nor_type_of_accents",
        ),
    ),
    "B7": Claim(
        "4.2",
        "a sad person shows less than a frightened one",
        (
            "papers/test_speech::the_sad_show_less_and_the_afraid_more",
            "test_paper_rows::emotion_alters_how_much_is_moved_but_not_where",
        ),
    ),
    "B8": Claim(
        "4.2",
        "the disgusted wrinkle the nose and the happy smile in silences",
        (
            "papers/test_speech::silences_are_punctuated_by_what_is_felt",
            "test_paper_rows::the_emotion_punctuates_in_its_own_way",
        ),
    ),
    "B9": Claim(
        "4.2",
        "another emotion is its action units and its rules",
        (
            "test_paper_rows::an_emotion_of_ones_own_shows_its_units",
            "rules/test_emotions::a_file_needs_targets_alone_and_its_emblem_is_the_display",
            "rules/test_tables::what_a_file_adds_can_be_performed_and_its_rules_know_it",
        ),
    ),
    "B10": Claim(
        "4.3",
        "look-ahead, geometric and temporal constraints, clusters by rate",
        (
            "blend/mouth/test_lookahead::oo_between_two_ees_protrudes_less_than_alone",
            "blend/mouth/test_lookahead::an_s_is_round_after_its_vowel_from_nine_phones_a_second_on",
            "blend/mouth/test_lookahead::consonants_take_the_vowel_to_come",
            "blend/mouth/test_lookahead::a_posture_remains_where_there_is_no_time_for_the_next",
        ),
    ),
    "B11": Claim(
        "4.4",
        "the head turns while nodding, both smaller",
        (
            "blend/test_directions::turning_while_nodding_makes_both_smaller",
            "test_paper_formulas::attenuated_directions_follow_the_formula",
        ),
    ),
    "B12": Claim(
        "6.4",
        "action units add; muscles come last",
        (
            "test_paper_formulas::attenuated_units_add_and_a_rival_leaves_a_fifth",
            "blend/test_action_unit_sums::units_of_channels_add_and_clip_before_they_become_muscles",
        ),
    ),
    "B13": Claim(
        "5.1",
        "the input has timing, brackets, accents, emotion",
        (
            "script/test_utt::all_of_it",
            "script/test_dectalk::durations_are_in_milliseconds_and_shared_by_what_is_two_sounds",
        ),
    ),
    "B14": Claim(
        "2.2.1",
        "accents answer the question",
        (
            "speech/structure/test_context::paper_b_s_answer_has_the_tones_that_it_prints",
            "speech/structure/test_context::accents_answer_the_question",
        ),
    ),
    "B15": Claim(
        "5.2",
        "an emotion has onset, apex and offset",
        (
            "papers/test_speech::a_surprise_that_has_a_start_alone_lasts_its_own_time",
            "test_paper_rows::a_display_rises_holds_and_falls_by_its_own_onset_and_offset",
        ),
    ),
    "B16": Claim(
        "5.2",
        "signals depend on the rate of speech",
        (
            "papers/test_speech::signals_are_shorter_and_smaller_in_fast_speech",
            "test_paper_rows::fast_speech_makes_signals_short_and_small",
        ),
    ),
    "B17": Claim(
        "5.2",
        "punctuators begin and end with their pause",
        (
            "test_paper_rows::punctuators_come_and_go_with_their_pause",
            "channels/test_rules_at_work::no_punctuator_begins_before_its_pause",
        ),
    ),
    "B18": Claim(
        "5.2",
        "the pause and the emotion choose the punctuator",
        (
            "papers/test_speech::questions_raise_the_brows",
            "test_paper_rows::questions_that_only_the_voice_asks_raise_the_brows_more",
            "channels/test_rules_at_work::the_type_of_punctuation_depends_on_the_emotion",
        ),
    ),
    "B19": Claim(
        "5.2",
        "a punctuator can be seen",
        ("channels/test_rules_at_work::punctuators_begin_with_their_pause_and_last_long_enough_to_be_seen",),
    ),
    "B20": Claim(
        "5.2",
        "pauses slow the head, commas too",
        (
            "channels/test_head::every_inner_pause_is_slower_than_half_of_speech",
            "test_paper_rows::commas_are_slow_and_accents_are_quick",
        ),
    ),
    "B21": Claim(
        "2.1",
        "a final pause is still",
        (
            "papers/test_speech::the_last_silence_is_still",
            "test_paper_rows::the_last_pause_is_still",
        ),
    ),
    "B22": Claim(
        "2.1",
        "movements accumulate on accents",
        (
            "papers/test_speech::most_accents_gather_several_kinds_of_movement",
            "test_paper_rows::accents_gather_rapid_movements",
        ),
    ),
    "B23": Claim(
        "5.2",
        "a blink takes 1/8, 1/24 and 1/12 s on phonemes; periodic ones fill in",
        (
            "test_paper_rows::blinks_of_paper_b",
            "papers/test_speech::periodic_blinks_fill_long_speech_and_silence",
            "papers/test_speech::natural_blinks_begin_on_phonemes_and_need_not_end_there",
        ),
    ),
    "B24": Claim(
        "5.2",
        "the speaker looks away at the start and at the listener at the end",
        (
            "papers/test_speech::the_eyes_rest_on_the_listener_at_the_end",
            "channels/test_paper_speakers::paper_b_looks_away_at_every_start_and_toward_the_listener_at_every_end",
            "test_paper_rows::the_speaker_looks_away_first_and_at_the_listener_last",
        ),
    ),
    "B25": Claim(
        "5.2",
        "without motion the head goes home",
        ("channels/test_head::the_head_has_gone_home_soon_after_the_last_word",),
    ),
    "B26": Claim(
        "5.2",
        "head and eyes act alike",
        (
            "channels/test_paper_speakers::paper_b_turns_the_head_with_every_look_away",
            "channels/test_eye_head::gaze_lands_with_the_eyes_and_stays_while_the_head_follows",
            "channels/test_eye_head::eyes_lead_and_the_head_moves_later",
        ),
    ),
    "B27": Claim(
        "4.1",
        "related utterances have one pattern of the head",
        (
            "papers/test_speech::related_sentences_move_the_head_alike",
            "test_paper_rows::related_utterances_move_the_head_alike",
        ),
    ),
    "B28": Claim(
        "5.2",
        "else the eyes scan the listener's face",
        (
            "papers/test_speech::eyes_scan_the_face_of_the_listener",
            "test_paper_rows::eyes_scan_the_listener_where_nothing_is_asked",
        ),
    ),
    "B29": Claim(
        "6.1",
        "the skin is a network of springs with feedback and viscosity",
        (
            "face/skin/test_springs::a_settled_skin_is_in_equilibrium",
            "face/skin/test_network::springs_pull_towards_the_neighbours_and_the_rest",
            "face/skin/test_springs::lag_and_overshoot_of_a_fast_contraction",
        ),
    ),
    "B30": Claim(
        "6.1",
        "six types of force, gathered for complex muscles",
        (
            "face/head/test_anatomy::a_muscle_gathers_forces_of_several_lines_and_types",
            "face/head/test_anatomy::each_type_of_a_gathered_force_moves_the_skin_its_way",
        ),
    ),
    "B31": Claim(
        "6.2",
        "wrinkles run across the muscle and grow with compression and age",
        (
            "face/skin/test_wrinkles::folds_grow_with_the_pull_without_jumps",
            "face/skin/test_wrinkles::every_region_folds_under_its_muscles_and_deepens_with_age",
            "face/skin/test_wrinkles::a_fold_keeps_the_skin_s_length",
        ),
    ),
    "B32": Claim(
        "6.3",
        "a table of links between muscles, 0 to 1, that a user edits",
        (
            "face/head/test_coupled_muscles::a_linked_muscle_contracts_by_the_weight_at_least",
            "rules/test_tables::a_changed_link_moves_the_skin",
            "test_unused_settings::links_of_a_file_of_rules_move_the_skin_of_poses_and_scores",
        ),
    ),
    "B33": Claim(
        "6",
        "dials, curves that can be edited, a face of lines",
        (
            "studio/faces/test_pose_editor::a_dialled_face_is_the_pose_of_the_command_line",
            "blend/test_manual::a_curve_can_be_drawn_lower",
            "looks/test_wireframe::every_side_of_a_quad_is_drawn_and_no_diagonal",
        ),
    ),
    "B34": Claim(
        "2.2",
        "affect changes pitch, loudness and tempo of the voice",
        (
            "papers/test_speech::anger_is_loud_and_quick_and_sadness_soft_and_slow",
            "speech/test_affect::changes_are_linear_in_the_intensity",
        ),
    ),
    "B35": Claim(
        "5.1",
        "a recorded voice with its times",
        (
            "speech/test_from_recording::lips_shut_where_the_recording_says",
            "speech/test_from_recording::a_textgrid_without_phones_is_aligned_by_its_words",
        ),
    ),
    "B36": Claim(
        "5",
        "the settings are the paper's (`--preset paper-b`)",
        ("channels/test_paper_speakers::the_presets_of_the_papers_are_complete_and_say_what_stays_ours",),
    ),
}
