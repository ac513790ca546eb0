#pragma once

#include <string>

namespace isocnc::debugger {

/// Lines count from 1: the first is empty of code.
inline const std::string kPart =
    "; a pocket and a hole\n"  // 1
    "G17 G71 G90\n"            // 2
    "G92 X100 Y50 Z0\n"        // 3
    "M06 T101001\n"            // 4
    "S18000 M03\n"             // 5
    "\n"                       // 6
    "G00 X10 Y5 Z20\n"         // 7
    "G01 Z-2 F1000\n"          // 8
    "X40 F3000\n"              // 9
    "V3=7\n"                   // 10
    "G03 X40 Y25 I40 J15\n"    // 11
    "IF V3 >= 7 GOTO N100\n"   // 12
    "G01 X0\n"                 // 13
    "N100 G00 Z50\n"           // 14
    "M06 T101002\n"            // 15
    "G01 X0 Y0 F2000\n"        // 16
    "M100 P1=2.5 P2=8\n"       // 17
    "G00 Z80\n"                // 18
    "M02\n";                   // 19

inline const std::string kWrong =
    "M06 T101001\n"
    "G00 X10 Y10 Z5\n"
    "G01 Z-1 F500\n"
    "G02 X20\n"
    "M02\n";

/// An arc in G49, which the machine drives as lines.
inline const std::string kFiveAxisArc =
    "M06 T101001\n"
    "G00 X0 Y0 Z10\n"
    "G49\n"
    "G03 X20 Y0 I10 J0 F1000\n"
    "G48\n"
    "M02\n";

}  // namespace isocnc::debugger
