import gc

import numpy as np

from risorius.core.audio import AudioWriter, silence


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
