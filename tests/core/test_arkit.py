from risorius.core.arkit import CSV_SHAPES, INDEX, OPPOSED, PACKET_SHAPES, ROTATIONS, SHAPES, column_of


def test_there_are_52_shapes_and_nine_rotations() -> None:
    assert len(set(SHAPES)) == len(set(CSV_SHAPES)) == 52
    assert set(CSV_SHAPES) == set(PACKET_SHAPES) == {column_of(name) for name in SHAPES}
    assert ROTATIONS[:4] == ("HeadYaw", "HeadPitch", "HeadRoll", "LeftEyeYaw")


def test_the_csv_has_right_before_left_where_packets_have_left_before_right() -> None:
    for part in ("Jaw", "Mouth"):
        assert CSV_SHAPES.index(f"{part}Right") < CSV_SHAPES.index(f"{part}Left")
        assert PACKET_SHAPES.index(f"{part}Left") < PACKET_SHAPES.index(f"{part}Right")
    assert CSV_SHAPES[:2] == ("EyeBlinkLeft", "EyeLookDownLeft")
    assert CSV_SHAPES[14:19] == ("JawForward", "JawRight", "JawLeft", "JawOpen", "MouthClose")
    assert CSV_SHAPES[-1] == "TongueOut"


def test_opposed_shapes_exist() -> None:
    assert all(name in INDEX for pair in OPPOSED for name in pair)
