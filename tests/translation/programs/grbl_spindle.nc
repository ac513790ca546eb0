; the tool is in the spindle when the program starts
G21 G90
M3 S10000
G4 P2
G0 Z5
X0Y0
G1 Z-1 F100
X10
G0 Z5
M5
M2
