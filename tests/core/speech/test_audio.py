import gc
import pickle

import numpy as np

from risorius.core.speech.audio import AudioWriter, silence


def test_what_is_written_is_read_back_in_blocks() -> None:
    samples = np.arange(-5000, 5000, dtype=np.int16)
    with AudioWriter(22_050) as writer:
        writer.append(samples[:3000])
        writer.append(samples[3000:])
        audio = writer.finish()
    assert audio.frames == 10_000
    assert audio.duration == 10_000 / 22_050
    np.testing.assert_array_equal(np.concatenate(list(audio.blocks(999))), samples)
    np.testing.assert_array_equal(audio.read(9_990, 100), samples[9_990:])


def test_the_file_is_deleted_when_the_sound_is_no_longer_used() -> None:
    audio = silence(0.1)
    path = audio.path
    assert path.exists()
    del audio
    gc.collect()
    assert not path.exists()


def test_a_pickle_holds_the_sound_and_not_its_file() -> None:
    with AudioWriter(16_000) as writer:
        writer.append(np.arange(100, dtype=np.int16))
        audio = writer.finish()
    pickled = pickle.dumps(audio)
    del audio
    gc.collect()
    again = pickle.loads(pickled)
    assert again.sample_rate == 16_000
    np.testing.assert_array_equal(again.read(), np.arange(100))
