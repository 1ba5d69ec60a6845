#include "pen_laser.h"

#include "figures.h"
#include "gpio.h"

enum { SERVO_COUNT_HZ = 1000000, SERVO_HZ = 50, LASER_COUNT_HZ = 21000000, LASER_HZ = 5000 };

static void pwm_start(timer_registers *timer, uint32_t count_hz, uint32_t hz, uint8_t channel)
{
    timer->PSC = timer_prescaler(APB1_TIMER_HZ, count_hz);
    timer->ARR = timer_reload(count_hz, hz);
    timer->CCMR[channel / 2] = (TIM_PWM_MODE_1 | TIM_PRELOAD) << 8 * (channel % 2);
    timer->CCER = 1u << 4 * channel;
    timer->EGR = TIM_UG;
    timer->CR1 = TIM_ARPE | TIM_CEN;
}

void pen_laser_start(void)
{
    pwm_start(TIM3, SERVO_COUNT_HZ, SERVO_HZ, 1);
    pwm_start(TIM4, LASER_COUNT_HZ, LASER_HZ, 2);
    pin_alternate(PIN_PEN, AF_TIM3_TO_5);
    pin_alternate(PIN_LASER, AF_TIM3_TO_5);
}

void pen_laser_write(float pen_us, float laser)
{
    TIM3->CCR[1] = pen_us > 0.0f ? (uint32_t)(pen_us + 0.5f) : 0;
    TIM4->CCR[2] = compare_for(laser, timer_reload(LASER_COUNT_HZ, LASER_HZ));
}
