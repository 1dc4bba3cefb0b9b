/* Local states: packed as bytes, known by number, and changed by messages and time. */
#ifndef REBSYNC_COMPONENTS_H
#define REBSYNC_COMPONENTS_H

#include "kernel_data.h"

static inline struct component *component(struct kernel *k, uint32_t rebec, uint32_t id)
{
    return (struct component *)k->actors[rebec].components.data + id;
}

/* --- packing: small numbers take one byte */

static unsigned char *put_number(unsigned char *to, cell value)
{
    uint64_t bits = ((uint64_t)value << 1) ^ (uint64_t)(value >> 63);
    for (; bits >= 128; bits >>= 7)
        *to++ = (unsigned char)(bits | 128);
    *to++ = (unsigned char)bits;
    return to;
}

static inline cell take_number(const unsigned char **from)
{
    uint64_t bits = 0, byte;
    int shift = 0;
    do {
        byte = *(*from)++;
        bits |= (byte & 127) << shift;
        shift += 7;
    } while (byte & 128);
    return (cell)(bits >> 1) ^ -(cell)(bits & 1);
}

static int arguments_of(struct kernel *k, cell server)
{
    return server < 0 ? 0 : k->model->server[server].arguments;
}

static unsigned char *put_message(struct kernel *k, unsigned char *to, const cell *message)
{
    cell due = message[DUE];
    to = put_number(to, message[ARRIVAL]);
    to = put_number(to, message[SERVER]);
    to = put_number(to, message[SENDER]);
    /* 0 is none; so times from 0 on are one more */
    to = put_number(to, due == NO_DEADLINE ? 0 : due >= 0 ? due + 1 : due);
    for (int i = 0, n = arguments_of(k, message[SERVER]); i < n; i++)
        to = put_number(to, message[ARGUMENTS + i]);
    return to;
}

static void take_message(struct kernel *k, const unsigned char **from, cell *message)
{
    memset(message, 0, k->model->stride * sizeof(cell));
    message[ARRIVAL] = take_number(from);
    message[SERVER] = take_number(from);
    message[SENDER] = take_number(from);
    cell due = take_number(from);
    message[DUE] = due == 0 ? NO_DEADLINE : due > 0 ? due - 1 : due;
    for (int i = 0, n = arguments_of(k, message[SERVER]); i < n; i++)
        message[ARGUMENTS + i] = take_number(from);
}

/* Packs a local state into k->text. */
static void pack_local(struct kernel *k, uint32_t rebec, const struct local *l)
{
    size_t stride = k->model->stride, variables = k->model->rebec[rebec].cells;
    size_t cells = 4 + variables + (l->messages + 1) * stride + l->frame_cells;
    unsigned char *to = room_for(k->escape, &k->text, cells * 10, 1);
    for (size_t i = 0; i < variables; i++)
        to = put_number(to, l->variables[i]);
    to = put_number(to, l->busy);
    if (k->model->reads_clock)
        to = put_number(to, l->clock);
    to = put_number(to, (cell)l->frame_count);
    to = put_number(to, (cell)l->messages);
    for (size_t i = 0; i < l->messages; i++)
        to = put_message(k, to, l->bag + i * stride);
    if (l->frame_count) {
        to = put_message(k, to, l->message);
        for (size_t i = 0; i < l->frame_cells; i++)
            to = put_number(to, l->frames[i]);
    }
    k->text.count = (size_t)((char *)to - k->text.data);
}

static void room_for_frames(struct kernel *k, struct local *l, size_t cells)
{
    if (!enough((void **)&l->frames, &l->frames_room, cells, sizeof(cell)))
        give_up(k->escape);
}

/* Room for so many messages in the bag. */
static void room_for_bag(struct kernel *k, struct local *l, size_t messages)
{
    if (!enough((void **)&l->bag, &l->bag_room, messages * k->model->stride, sizeof(cell)))
        give_up(k->escape);
}

static void unpack_frames(struct kernel *k, const unsigned char *from, struct local *l)
{
    size_t at = 0;
    for (size_t frame = 0; frame < l->frame_count; frame++) {
        cell pc = take_number(&from), count = take_number(&from);
        room_for_frames(k, l, at + 2 + count);
        l->frames[at++] = pc;
        l->frames[at++] = count;
        for (; count; count--)
            l->frames[at++] = take_number(&from);
    }
    l->frame_cells = at;
}

/* Unpacks the content of a local state. */
static void take_local(struct kernel *k, uint32_t rebec, const unsigned char *from, struct local *l)
{
    size_t stride = k->model->stride, variables = k->model->rebec[rebec].cells;
    for (size_t i = 0; i < variables; i++)
        l->variables[i] = take_number(&from);
    l->busy = take_number(&from);
    l->clock = k->model->reads_clock ? take_number(&from) : 0;
    l->frame_count = (size_t)take_number(&from);
    l->messages = (size_t)take_number(&from);
    room_for_bag(k, l, l->messages);
    for (size_t i = 0; i < l->messages; i++)
        take_message(k, &from, l->bag + i * stride);
    l->frame_cells = 0;
    if (l->frame_count) {
        take_message(k, &from, l->message);
        unpack_frames(k, from, l);
    }
}

static void unpack_local(struct kernel *k, uint32_t rebec, uint32_t id, struct local *l)
{
    const char *bytes = k->actors[rebec].bytes.data + component(k, rebec, id)->at;
    take_local(k, rebec, (const unsigned char *)bytes, l);
}

/* --- what a local state means for the whole */

static int32_t priority_of(struct kernel *k, cell server)
{
    return server < 0 ? INT32_MAX : k->model->server[server].priority;
}

/* The best priority of the messages that have come first. */
static int32_t best_priority(struct kernel *k, const struct local *l)
{
    int32_t best = INT32_MAX;
    const cell *message = l->bag;
    for (size_t i = 0; i < l->messages && message[ARRIVAL] == l->bag[ARRIVAL]; i++) {
        int32_t priority = priority_of(k, message[SERVER]);
        best = priority < best ? priority : best;
        message += k->model->stride;
    }
    return best;
}

static int64_t next_time(struct kernel *k, const struct local *l)
{
    if (l->frame_count)
        return l->busy;
    if (!l->messages)
        return NEVER;
    int64_t arrival = l->bag[ARRIVAL], least = k->semantics == TTS ? arrival : 0;
    if (k->semantics == FTTS) {
        least = arrival > l->busy ? arrival : l->busy;
        least = least > 0 ? least : 0;
    }
    return least;
}

static void describe(struct kernel *k, uint32_t rebec, const struct local *l, struct component *c)
{
    int suspended = l->frame_count > 0;
    const cell *bag = l->bag;
    int able = suspended ? !l->busy : l->messages && !l->busy && bag[ARRIVAL] <= 0;
    c->next = next_time(k, l);
    c->outcomes = NONE;
    c->places = (uint32_t)(l->messages + (suspended && l->message[SERVER] >= 0));
    c->flags = able ? ABLE : 0;
    if (!suspended && !l->messages && !l->busy && !k->model->reads_clock)
        c->flags |= STILL;
    c->rank = k->semantics == CORE ? 0 : k->model->rebec[rebec].priority;
    if (able && k->model->global_ranks && k->semantics != CORE)
        c->rank = suspended ? priority_of(k, l->message[SERVER]) : best_priority(k, l);
}

/* --- numbers of local states */

static size_t length_of(struct actor *a, uint32_t id)
{
    struct component *c = (struct component *)a->components.data + id;
    return (id + 1 < a->components.count ? c[1].at : a->bytes.count) - c->at;
}

static uint64_t content_hash(struct kernel *k, uint32_t rebec, uint32_t id)
{
    struct actor *a = k->actors + rebec;
    return hash_of(a->bytes.data + component(k, rebec, id)->at, length_of(a, id));
}

static void enlarge_table(struct kernel *k, struct actor *a)
{
    uint64_t size = a->mask ? 2 * (a->mask + 1) : TABLE, *table = zeroed(k->escape, size, sizeof *table);
    for (uint64_t i = 0; a->mask && i <= a->mask; i++) {
        uint64_t entry = a->table[i], at = (entry >> 32) & (size - 1);
        if (!entry)
            continue;
        while (table[at])
            at = (at + 1) & (size - 1);
        table[at] = entry;
    }
    free(a->table);
    a->table = table;
    a->mask = size - 1;
}

/* The number of a local state. */
static uint32_t number_of(struct kernel *k, uint32_t rebec, const struct local *l)
{
    struct actor *a = k->actors + rebec;
    pack_local(k, rebec, l);
    if (4 * a->components.count >= 3 * a->mask)
        enlarge_table(k, a);
    size_t length = k->text.count;
    uint64_t content = hash_of(k->text.data, length), hash = content >> 32, at = hash & a->mask;
    for (; a->table[at]; at = (at + 1) & a->mask) {
        uint32_t id = (uint32_t)a->table[at] - 1;
        if (a->table[at] >> 32 != hash)
            continue;
        const char *bytes = a->bytes.data + component(k, rebec, id)->at;
        if (length_of(a, id) == length && !memcmp(bytes, k->text.data, length))
            return id;
    }
    if (a->components.count >= NONE - 1)
        give_up(k->escape);
    room_for(k->escape, &a->bytes, a->bytes.count + length, 1);
    if (k->hashes)
        *(uint64_t *)added(k->escape, &a->hashes, sizeof content) = content;
    struct component *c = added(k->escape, &a->components, sizeof *c);
    memcpy(a->bytes.data + a->bytes.count, k->text.data, length);
    c->at = a->bytes.count;
    a->bytes.count += length;
    describe(k, rebec, l, c);
    a->table[at] = hash << 32 | a->components.count;
    uint32_t id = (uint32_t)a->components.count - 1;
    if (k->meet)
        k->meet(k->meeter, rebec, id);
    return id;
}

/* --- what changes it, remembered */

static void enlarge_memo(struct kernel *k, struct memo *m, uint64_t components)
{
    uint64_t size = m->entries ? m->mask + 1 : 0, most = k->hashes ? MEMO_BESIDE : MEMO_AT_MOST;
    if (size >= most || 4 * components <= size)
        return;
    size = MEMO;
    while (size < 8 * components && size < most)
        size *= 2;
    uint64_t *entries = malloc(size * sizeof *entries);
    if (!entries && m->entries)
        return;
    if (!entries)
        give_up(k->escape);
    memset(in_large_pages(entries, size * sizeof *entries), 255, size * sizeof *entries);
    free(m->entries);
    m->entries = entries;
    m->mask = size - 1;
    m->bits = (uint32_t)__builtin_ctzll(size);
}

/* The place of a question about a local state, and what tells it there from others (a quotient); NULL
 * when the numbers are too large for that. */
static inline uint64_t *place_in(struct memo *m, uint32_t id, uint32_t asked, uint32_t *rest)
{
    uint32_t high = id >> m->bits;
    if (high >> 8 || asked >> 24)
        return NULL;
    *rest = high << 24 | asked;
    return m->entries + ((id ^ ((asked * UINT64_C(0x9E3779B97F4A7C15)) >> 40)) & m->mask);
}

/* A result that is remembered, or NONE. */
static inline uint32_t recall(struct memo *m, uint32_t id, uint32_t asked)
{
    uint32_t rest = 0;
    uint64_t *place = place_in(m, id, asked, &rest), entry = place ? *place : UINT64_MAX;
    return entry >> 32 == rest ? (uint32_t)entry : NONE;
}

static inline uint32_t memorise(struct memo *m, uint32_t id, uint32_t asked, uint32_t result)
{
    uint32_t rest;
    uint64_t *place = place_in(m, id, asked, &rest);
    if (place)
        *place = (uint64_t)rest << 32 | result;
    return result;
}

static void pass_message(cell *message, int64_t time)
{
    message[ARRIVAL] -= time;
    if (message[DUE] != NO_DEADLINE)
        message[DUE] -= time;
}

static uint32_t compute_later(struct kernel *k, uint32_t rebec, uint32_t id, int64_t time)
{
    struct local *l = &k->scratch;
    unpack_local(k, rebec, id, l);
    for (size_t i = 0; i < l->messages; i++)
        pass_message(l->bag + i * k->model->stride, time);
    if (l->frame_count)
        pass_message(l->message, time);
    l->busy = l->busy > time ? l->busy - time : 0;
    l->clock += time;
    enlarge_memo(k, &k->actors[rebec].passed, k->actors[rebec].components.count);
    return number_of(k, rebec, l);
}

/* The local state when so much time has passed. */
static inline uint32_t later(struct kernel *k, uint32_t rebec, uint32_t id, int64_t time)
{
    if (component(k, rebec, id)->flags & STILL)
        return id;
    if (time >> 31)
        return compute_later(k, rebec, id, time);
    struct memo *memo = &k->actors[rebec].passed;
    uint32_t after = recall(memo, id, (uint32_t)time);
    if (after == NONE)
        after = memorise(memo, id, (uint32_t)time, compute_later(k, rebec, id, time));
    return after;
}

static int compare_messages(const cell *a, const cell *b, size_t stride)
{
    for (size_t i = 0; i < stride; i++)
        if (a[i] != b[i])
            return a[i] < b[i] ? -1 : 1;
    return 0;
}

/* Puts a message into a bag: a sorted multiset, or a queue. */
static void insert_message(struct kernel *k, struct local *l, const cell *message)
{
    size_t stride = k->model->stride, at = l->messages++;
    room_for_bag(k, l, l->messages);
    while (k->semantics != CORE && at &&
           compare_messages(l->bag + (at - 1) * stride, message, stride) > 0) {
        memcpy(l->bag + at * stride, l->bag + (at - 1) * stride, stride * sizeof(cell));
        at--;
    }
    memcpy(l->bag + at * stride, message, stride * sizeof(cell));
}

/* Takes out what is lost when another message comes for a server: its oldest, if it has no more
 * than so many. */
static void displace(struct kernel *k, struct local *l, cell server)
{
    size_t depth = server < 0 ? 0 : (size_t)k->model->server[server].depth, stride = k->model->stride;
    size_t waiting = 0, oldest = l->messages;
    for (size_t i = l->messages; depth && i-- > 0;)
        if (l->bag[i * stride + SERVER] == server) {
            oldest = i;
            waiting++;
        }
    if (!depth || waiting < depth)
        return;
    memmove(l->bag + oldest * stride, l->bag + (oldest + 1) * stride,
            (l->messages - oldest - 1) * stride * sizeof(cell));
    l->messages--;
}

static uint32_t compute_received(struct kernel *k, uint32_t rebec, uint32_t id, uint32_t message)
{
    struct actor *a = k->actors + rebec;
    const cell *new = (cell *)k->messages.data + (size_t)message * k->model->stride;
    uint32_t places = component(k, rebec, id)->places + 1;
    unpack_local(k, rebec, id, &k->scratch);
    size_t before = k->scratch.messages;
    displace(k, &k->scratch, new[SERVER]);
    places -= (uint32_t)(before - k->scratch.messages);
    insert_message(k, &k->scratch, new);
    a->largest = places > a->largest ? places : a->largest;
    enlarge_memo(k, &a->received, a->components.count);
    return number_of(k, rebec, &k->scratch);
}

/* The local state with one more message, for which there is a place. */
static inline uint32_t received(struct kernel *k, uint32_t rebec, uint32_t id, uint32_t message)
{
    struct memo *memo = &k->actors[rebec].received;
    uint32_t after = recall(memo, id, message);
    if (after == NONE)
        after = memorise(memo, id, message, compute_received(k, rebec, id, message));
    return after;
}

/* --- numbers of messages */

static void enlarge_message_table(struct kernel *k)
{
    size_t stride = k->model->stride;
    uint64_t size = k->message_mask ? 2 * (k->message_mask + 1) : TABLE;
    uint32_t *table = zeroed(k->escape, size, sizeof *table);
    for (uint32_t id = 0; id < k->messages.count; id++) {
        const cell *message = (cell *)k->messages.data + (size_t)id * stride;
        uint64_t at = hash_of(message, stride * sizeof(cell)) & (size - 1);
        while (table[at])
            at = (at + 1) & (size - 1);
        table[at] = id + 1;
    }
    free(k->message_table);
    k->message_table = table;
    k->message_mask = size - 1;
}

static uint32_t message_number(struct kernel *k, const cell *message)
{
    size_t size = k->model->stride * sizeof(cell);
    if (2 * k->messages.count >= k->message_mask)
        enlarge_message_table(k);
    uint64_t at = hash_of(message, size) & k->message_mask;
    for (; k->message_table[at]; at = (at + 1) & k->message_mask) {
        uint32_t id = k->message_table[at] - 1;
        if (!memcmp(k->messages.data + id * size, message, size))
            return id;
    }
    memcpy(added(k->escape, &k->messages, size), message, size);
    k->message_table[at] = (uint32_t)k->messages.count;
    return (uint32_t)k->messages.count - 1;
}

#endif
