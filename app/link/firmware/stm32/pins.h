/* Every pin of the STM32F407 Discovery that is used, in one table: STM32.md says what to connect where.
 *
 * All but the lamp are free on the board: its microphone, audio chip, accelerometer, button and USB keep theirs.
 */
#ifndef PINS_H
#define PINS_H

#define PIN(port, number) ((port) * 16 + (number))
enum { PORT_A, PORT_B, PORT_C, PORT_D, PORT_E };

#define PIN_SERIAL_TX PIN(PORT_A, 2) /* USART2 */
#define PIN_SERIAL_RX PIN(PORT_A, 3)

#define PIN_SENSOR(j) ((const uint8_t[]){PIN(PORT_B, 0), PIN(PORT_B, 1), PIN(PORT_C, 1), PIN(PORT_C, 2)}[j])
#define SENSOR_CHANNELS {8, 9, 11, 12} /* of the ADC, the same pins */

#define PIN_PWM(j) PIN(PORT_E, ((const uint8_t[]){9, 11, 13, 14}[j])) /* TIM1, channels 1 to 4 */
#define PIN_IN_A(j) PIN(PORT_D, (j))                                  /* PD0..PD3 */
#define PIN_IN_B(j) PIN(PORT_D, 6 + (j))                              /* PD6..PD9 */

#define PORT_STEP PORT_D /* steppers instead of DC motors: PD0..PD3 step, PD6..PD9 direction */
#define PIN_STEP(j) PIN(PORT_STEP, (j))
#define PIN_DIRECTION(j) PIN(PORT_D, 6 + (j))

#define PIN_POWER PIN(PORT_D, 10)            /* high: the motors may have power */
#define PIN_STEPPERS_DISABLED PIN(PORT_D, 11) /* the drivers' ENABLE input, which is active low */
#define PIN_LAMP PIN(PORT_D, 12)              /* the green one on the board: the motors have power */
#define PIN_ESTOP PIN(PORT_E, 15)            /* TIM1's break input: closed to ground when all is well */
#define PIN_SWITCH(j) PIN(PORT_B, 12 + (j))  /* PB12..PB15, closed to ground at the end of travel */

#define PIN_PEN PIN(PORT_B, 5)   /* TIM3, channel 2 */
#define PIN_LASER PIN(PORT_B, 8) /* TIM4, channel 3 */

#define PIN_DISPLAY_RS PIN(PORT_E, 2)
#define PIN_DISPLAY_E PIN(PORT_E, 4)
#define PIN_DISPLAY_DATA(i) PIN(PORT_E, 5 + (i)) /* PE5..PE8 to the display's D4..D7 */

enum { AF_TIM1 = 1, AF_TIM3_TO_5 = 2, AF_USART2 = 7 };

#endif
