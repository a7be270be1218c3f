//! `UpdateTrajectory`: where sensors go from now on, in place of what is registered.

use serde::{Deserialize, Serialize};

use super::remembered::Remembered;
use crate::domain::{Call, UpdateTrajectories, rules};
use crate::store::cells::text;
use crate::store::writer::{Command, Failure, Writing};

/// New trajectories of a network's sensors.
#[derive(Debug)]
pub struct UpdatePaths(pub Call<UpdateTrajectories>);

#[derive(Serialize, Deserialize)]
struct Answer {
    updated: u32,
}

impl Command for UpdatePaths {
    type Answer = u32;

    async fn apply(&self, w: &mut Writing) -> Result<u32, Failure> {
        let UpdateTrajectories { network_id, trajectories } = &self.0.content;
        let call = Remembered::new("trajectories", network_id, &self.0);
        if let Some(Answer { updated }) = call.find(w).await? {
            return Ok(updated);
        }
        let network = w.network(network_id).await?;
        rules::trajectories(&network, trajectories)?;
        let now_us = w.now_us();
        for (sensor, waypoints) in trajectories {
            sqlx::query(
                "INSERT INTO trajectories (network_id, sensor_id, waypoints, updated_us) \
                 VALUES (?1, ?2, ?3, ?4) ON CONFLICT (network_id, sensor_id) \
                 DO UPDATE SET waypoints = ?3, updated_us = ?4",
            )
            .bind(network_id.as_str())
            .bind(sensor.as_str())
            .bind(text(waypoints))
            .bind(now_us)
            .execute(&mut w.conn)
            .await?;
        }
        let updated = u32::try_from(trajectories.len()).unwrap_or(u32::MAX);
        call.keep(w, &Answer { updated }).await?;
        Ok(updated)
    }
}
