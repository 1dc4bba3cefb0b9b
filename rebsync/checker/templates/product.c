/* The product of a state space and an automaton: is there a run that is accepted and fair?
 *
 * It is that of temporal/emptiness.py, in the same order; what its parts mean is said there and
 * in temporal/product.py. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "pearce.h"

enum { DONE, MORE, NO_MEMORY };
enum { EXPLORING, JOINING, JUDGING, OVER };
enum { NO_FAIRNESS, WEAK, PROGRESS };

/* What the automaton can do on a class of states: its moves begin at `move`. */
struct choice {
    uint32_t move, outside, inside, decides;
};

/* `kept` are the goals that a move within its component reaches. */
struct move {
    uint64_t place, kept;
};

struct product {
    const uint64_t *first;
    const int64_t *target, *time;
    const int32_t *actor, *label;
    const struct choice *choice;
    const struct move *move;
    uint64_t states, width, full;
    int32_t shift, fairness, decisive, phase;
    uint64_t nodes, room, at;
    int64_t decided, entry;
    int32_t *number, *parent, *rank; /* rank is at last the component, above 0 */
    uint64_t *key, *goals;
    struct pearce *joining; /* while components are made */
};

/* The predicates of each state side by side, bit by bit. */
void rebsync_classes(const uint64_t *labels, uint64_t words, uint64_t states, const uint32_t *predicate,
                     uint32_t predicates, int32_t *class)
{
    for (uint64_t s = 0; s < states; s++, labels += words) {
        int32_t bits = 0;
        for (uint32_t p = 0; p < predicates; p++)
            bits |= (int32_t)(labels[predicate[p] / 64] >> predicate[p] % 64 & 1) << p;
        class[s] = bits;
    }
}

static const struct choice *choice_of(const struct product *p, uint64_t key)
{
    return p->choice + (uint64_t)p->label[key / p->width] * p->width + key % p->width;
}

static int is_stuck(const struct product *p, uint64_t state)
{
    for (uint64_t e = p->first[state]; e < p->first[state + 1]; e++)
        if (p->target[e] >= 0)
            return 0;
    return 1;
}

/* --- exploring */

static int more_room(struct product *p)
{
    uint64_t room = p->room ? 2 * p->room : 4096;
    uint64_t *key = realloc(p->key, room * sizeof *key);
    p->key = key ? key : p->key;
    int32_t *parent = realloc(p->parent, room * sizeof *parent);
    p->parent = parent ? parent : p->parent;
    p->room = key && parent ? room : p->room;
    return key && parent;
}

static int meet(struct product *p, uint64_t key, int64_t parent)
{
    if (p->number[key] >= 0)
        return 1;
    if (p->nodes == p->room && !more_room(p))
        return 0;
    p->number[key] = (int32_t)p->nodes;
    p->parent[p->nodes] = (int32_t)parent;
    p->key[p->nodes++] = key;
    return 1;
}

static int meet_all(struct product *p, const struct choice *c, uint64_t state, uint64_t node)
{
    for (uint32_t m = 0; m < c->outside + c->inside; m++)
        if (!meet(p, state * p->width + p->move[c->move + m].place, (int64_t)node))
            return 0;
    return 1;
}

static int expand(struct product *p, uint64_t node)
{
    uint64_t state = p->key[node] / p->width;
    const struct choice *c = choice_of(p, p->key[node]);
    if (c->outside + c->inside == 0)
        return 1;
    if (p->decisive && c->decides) {
        p->decided = (int64_t)node;
        return 1;
    }
    int stuck = 1;
    for (uint64_t e = p->first[state]; e < p->first[state + 1]; e++)
        if (p->target[e] >= 0) {
            stuck = 0;
            if (!meet_all(p, c, (uint64_t)p->target[e], node))
                return 0;
        }
    return stuck ? meet_all(p, c, state, node) : 1;
}

static int explore(struct product *p, uint64_t steps)
{
    for (; steps && p->at < p->nodes && p->decided < 0; steps--)
        if (!expand(p, p->at++))
            return NO_MEMORY;
    if (p->decided >= 0)
        p->phase = OVER;
    else if (p->at == p->nodes)
        p->phase = JOINING;
    return MORE;
}

/* --- components */

/* Step i of a node within its component of the automaton. */
static int64_t successor(const void *of, uint64_t node, uint64_t i)
{
    const struct product *p = of;
    uint64_t state = p->key[node] / p->width;
    const struct choice *c = choice_of(p, p->key[node]);
    if (!c->inside)
        return NO_MORE;
    uint64_t edge = p->first[state] + i / c->inside, to = state;
    uint64_t place = p->move[c->move + c->outside + i % c->inside].place;
    if (edge > p->first[state + 1])
        return NO_MORE;
    if (edge < p->first[state + 1]) {
        if (p->target[edge] < 0)
            return SKIPPED;
        to = (uint64_t)p->target[edge];
    } else if (!is_stuck(p, state))
        return NO_MORE;
    return p->number[to * p->width + place];
}

static int join(struct product *p, uint64_t steps)
{
    if (!p->rank) {
        p->rank = calloc(p->nodes + 1, sizeof *p->rank);
        p->joining = calloc(1, sizeof *p->joining);
        if (!p->rank || !p->joining || !pearce_begin(p->joining, p, p->nodes, p->rank, NULL))
            return NO_MEMORY;
    }
    if (pearce_go_on(p->joining, steps))
        return MORE;
    pearce_end(p->joining);
    p->goals = calloc(p->nodes + 1, sizeof *p->goals);
    p->at = 0;
    p->phase = JUDGING;
    return p->goals ? MORE : NO_MEMORY;
}

/* --- goals */

/* The rebecs that have a step that does not fail, as goals. */
static uint64_t able(const struct product *p, uint64_t state)
{
    uint64_t rebecs = 0;
    for (uint64_t e = p->first[state]; e < p->first[state + 1]; e++)
        if (p->target[e] >= 0 && p->actor[e] >= 0)
            rebecs |= UINT64_C(1) << p->actor[e] << p->shift;
    return rebecs;
}

/* The goals of fairness that an edge reaches. */
static uint64_t fair(const struct product *p, uint64_t edge, uint64_t idle)
{
    if (p->fairness == PROGRESS)
        return (uint64_t)(p->time[edge] > 0) << p->shift;
    if (p->fairness == WEAK && p->actor[edge] >= 0)
        return idle | UINT64_C(1) << p->actor[edge] << p->shift;
    return idle;
}

static void reach_goals(struct product *p, uint64_t node)
{
    uint64_t state = p->key[node] / p->width, begin = p->first[state], end = p->first[state + 1];
    const struct choice *c = choice_of(p, p->key[node]);
    if (!c->inside)
        return;
    uint64_t all = p->full >> p->shift << p->shift;
    uint64_t idle = p->fairness == WEAK ? all & ~able(p, state) : 0;
    int stuck = is_stuck(p, state);
    for (uint64_t e = begin; e < (stuck ? begin + 1 : end); e++) {
        if (!stuck && p->target[e] < 0)
            continue;
        uint64_t to = stuck ? state : (uint64_t)p->target[e];
        uint64_t reached = stuck ? all : fair(p, e, idle);
        for (uint32_t m = c->outside; m < c->outside + c->inside; m++) {
            const struct move *move = p->move + c->move + m;
            if (p->rank[p->number[to * p->width + move->place]] == p->rank[node])
                p->goals[p->rank[node]] |= move->kept | reached;
        }
    }
}

static int judge(struct product *p, uint64_t steps)
{
    for (; steps && p->at < p->nodes; steps--, p->at++)
        if (p->goals[p->rank[p->at]] != p->full)
            reach_goals(p, p->at);
    if (p->at < p->nodes)
        return MORE;
    for (uint64_t node = 0; node < p->nodes && p->entry < 0; node++)
        if (p->goals[p->rank[node]] == p->full)
            p->entry = (int64_t)node;
    p->phase = OVER;
    return MORE;
}

/* --- from outside */

/* Makes room, and meets the initial states; the fields down to `phase` are given. */
int rebsync_product_begin(struct product *p, const uint64_t *initial, uint64_t initials)
{
    p->decided = p->entry = -1;
    p->number = malloc((p->states * p->width + 1) * sizeof *p->number);
    if (!p->number)
        return NO_MEMORY;
    memset(p->number, 255, p->states * p->width * sizeof *p->number);
    for (uint64_t i = 0; i < initials; i++)
        if (!meet(p, initial[i] * p->width, -1 - (int64_t)i))
            return NO_MEMORY;
    return MORE;
}

/* Goes on for so many steps: MORE, or DONE when `decided` and `entry` are known. */
int rebsync_product_go_on(struct product *p, uint64_t steps)
{
    switch (p->phase) {
    case EXPLORING:
        return explore(p, steps);
    case JOINING:
        return join(p, steps);
    case JUDGING:
        return judge(p, steps);
    default:
        return DONE;
    }
}

void rebsync_product_end(struct product *p)
{
    if (p->joining)
        pearce_end(p->joining);
    free(p->joining);
    free(p->number);
    free(p->parent);
    free(p->rank);
    free(p->key);
    free(p->goals);
}
