/* What the robot holds: the pen's servo and the laser. */
#ifndef PEN_LASER_H
#define PEN_LASER_H

void pen_laser_start(void);
/* Pulse of the servo (0: none), and the laser's power 0..1. */
void pen_laser_write(float pen_us, float laser);

#endif
