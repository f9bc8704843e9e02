"""Many cylinders on one shaft: layout and firing order, torque, bearings, wear, balance, harmonics."""
