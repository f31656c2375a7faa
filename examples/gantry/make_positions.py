"""Write positions.csv: 200 parts on a belt, as a camera would measure them, and their places in four trays."""

import csv
import random
from pathlib import Path

TRAYS = [(60.0, 560.0), (360.0, 560.0), (660.0, 560.0), (960.0, 560.0)]  # corner of each tray, mm
COLUMNS, ROWS, PITCH = 10, 5, 24.0  # places of a tray
BELT_X, BELT_Y = (80.0, 1160.0), (40.0, 380.0)


def main() -> None:
    """Write one line per part: where it lies, how high it is, where it goes."""
    draw = random.Random(20251124)
    with Path(__file__).with_name("positions.csv").open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["pick_x", "pick_y", "pick_z", "place_x", "place_y", "place_z"])
        for number in range(200):
            tray_x, tray_y = TRAYS[number % 4]
            row, column = divmod(number // 4, COLUMNS)
            pick = draw.uniform(*BELT_X), draw.uniform(*BELT_Y), draw.choice([12.0, 18.0, 25.0])
            place = tray_x + column * PITCH, tray_y + row * PITCH, pick[2] + 6.0
            table.writerow([f"{value:.3f}" for value in (*pick, *place)])


if __name__ == "__main__":
    main()
