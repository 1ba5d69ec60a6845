/* Where each number of a geometry lies; see PROTOCOL.md for what they mean. */
#ifndef DL_GEOMETRY_H
#define DL_GEOMETRY_H

enum { DL_ARM, DL_ROD, DL_HEIGHT, DL_LEGS, DL_LEG_SIZE = 5 };          /* par4 and delta3 */
enum { DL_LEG_COS, DL_LEG_SIN, DL_LEG_X, DL_LEG_Y, DL_LEG_LINK };      /* of a leg */
enum { DL_RAIL_ROD, DL_RAILS };                                        /* linear */
enum { DL_HALF_BASE, DL_PROXIMAL, DL_DISTAL, DL_TURN_A_METRE };        /* fivebar */

#endif
