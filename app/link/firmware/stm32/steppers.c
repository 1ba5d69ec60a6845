#include "steppers.h"

#include "figures.h"
#include "gpio.h"

/* Every other interrupt decides, the one after it ends the pulse: at most 25 000 steps a second, pulses of 20 us. */
enum { INTERRUPT_HZ = 50000, DECISIONS_PER_MS = INTERRUPT_HZ / 2 / 1000 };

static step_axis axes[DL_JOINTS];
static uint8_t raised;

uint8_t step_axis_aim(step_axis *axis, int32_t target, uint32_t decisions)
{
    const int32_t left = target - axis->made;
    const int8_t direction = left < 0 ? -1 : 1;
    const uint32_t steps = (uint32_t)(left * direction);
    if (direction != axis->direction) axis->phase = 0; /* time for the driver to see the new direction */
    axis->direction = direction;
    axis->target = target;
    axis->rate = steps < decisions ? 0xFFFFFFFFu / decisions * steps + steps : 0xFFFFFFFFu;
    return direction > 0;
}

uint8_t step_axis_decide(step_axis *axis)
{
    const uint32_t before = axis->phase;
    axis->phase += axis->rate;
    if (axis->made == axis->target || axis->phase >= before) return 0;
    axis->made += axis->direction;
    return 1;
}

void steppers_start(void)
{
    pin_write(PIN_STEPPERS_DISABLED, 1);
    pin_output(PIN_STEPPERS_DISABLED);
    for (uint8_t j = 0; j < DL_JOINTS; j++) {
        pin_output(PIN_STEP(j));
        pin_output(PIN_DIRECTION(j));
    }
    TIM7->ARR = timer_reload(APB1_TIMER_HZ, INTERRUPT_HZ);
    TIM7->DIER = TIM_UIE;
    NVIC_ENABLE(IRQ_TIM7);
    TIM7->CR1 = TIM_CEN;
}

void steppers_read(float made[DL_JOINTS])
{
    for (uint8_t j = 0; j < DL_JOINTS; j++) made[j] = (float)axes[j].made;
}

void steppers_write(uint8_t powered, const float target[DL_JOINTS])
{
    pin_write(PIN_STEPPERS_DISABLED, !powered);
    for (uint8_t j = 0; j < DL_JOINTS; j++) {
        const int32_t wanted = powered ? (int32_t)(target[j] + (target[j] < 0.0f ? -0.5f : 0.5f)) : axes[j].made;
        interrupts_off();
        const uint8_t forwards = step_axis_aim(&axes[j], wanted, DECISIONS_PER_MS);
        interrupts_on();
        pin_write(PIN_DIRECTION(j), forwards);
    }
}

void TIM7_IRQHandler(void)
{
    TIM7->SR = ~(uint32_t)TIM_UIF;
    if (raised) {
        port_write(PORT_STEP, 0, raised);
        raised = 0;
        return;
    }
    for (uint8_t j = 0; j < DL_JOINTS; j++) raised |= step_axis_decide(&axes[j]) << j;
    port_write(PORT_STEP, raised, 0);
}
