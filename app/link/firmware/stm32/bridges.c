#include "bridges.h"

#include "figures.h"
#include "gpio.h"

enum { PWM_HZ = 20000 };
static const uint32_t reload = APB2_TIMER_HZ / PWM_HZ - 1;

/* The emergency stop is TIM1's break input as well: an open one takes the PWM away without a program. */
void bridges_start(void)
{
    TIM1->ARR = reload;
    const uint32_t output = TIM_PWM_MODE_1 | TIM_PRELOAD;
    TIM1->CCMR[0] = TIM1->CCMR[1] = output | output << 8;
    TIM1->CCER = 0x1111; /* the four channels drive their pins, active high */
    TIM1->BDTR = TIM_BKE | TIM_BKP | TIM_OSSR | TIM_OSSI; /* stopped, the pins are held low */
    TIM1->EGR = TIM_UG;
    TIM1->CR1 = TIM_ARPE | TIM_CEN;
    for (uint8_t j = 0; j < DL_JOINTS; j++) {
        pin_output(PIN_IN_A(j));
        pin_output(PIN_IN_B(j));
        pin_alternate(PIN_PWM(j), AF_TIM1);
    }
}

static void drive_motor(uint8_t j, float share)
{
    pin_write(PIN_IN_A(j), share > 0.0f);
    pin_write(PIN_IN_B(j), share < 0.0f);
    TIM1->CCR[j] = compare_for(share < 0.0f ? -share : share, reload);
}

void bridges_write(uint8_t powered, const float drive[DL_JOINTS])
{
    for (uint8_t j = 0; j < DL_JOINTS; j++) drive_motor(j, powered ? drive[j] : 0.0f);
    if (powered)
        TIM1->BDTR |= TIM_MOE; /* stays 0 while the break input is open */
    else
        TIM1->BDTR &= ~(uint32_t)TIM_MOE;
}
